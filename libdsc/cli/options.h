/// \file
/// The command line of `dsc`, read and checked before anything is computed.
#pragma once

#include "libdsc/base/types.h"
#include "libdsc/calculus/options.h"
#include "libdsc/io/volume_source.h"
#include "libdsc/normals/curvature.h"
#include "libdsc/normals/integral_invariant.h"
#include "libdsc/render/picture.h"
#include "libdsc/surface/extract.h"
#include "libdsc/voxels/label_volume.h"

#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace dsc::cli {

enum class Command {
  info,
  voxels,
  surface,
  normals,
  gradient,
  diffuse,
  geodesic,
  spectrum,
  curvature,
  laplacian,
  poisson
};
enum class Estimator { integral_invariant, trivial, analytic };
enum class CurvatureEstimator { integral_invariant, laplacian };
enum class BoundaryChoice { neumann, mixed };
enum class DistanceMethod { automatic, direct, bands };

/// Everything that the command line can say. An option that a command does not have keeps its
/// default there.
struct Options {
  Command command = Command::info;

  // what is read
  std::string input;                               ///< a volume file, a mesh file or shape:…
  std::optional<Vec3> gridstep;                    ///< world units per axis
  std::optional<RawLayout> raw;                    ///< of a raw file
  bool raw_type = false;                           ///< whether its type was given
  std::optional<std::array<double, 2>> threshold;  ///< inside is LO <= value <= HI
  std::optional<double> above, up_to;              ///< as typed by -m, -M: LO < value <= HI
  std::vector<std::int64_t> labels;                ///< inside is any of these
  std::optional<std::string> grid;                 ///< of a .vdb file, by its name
  bool all_labels = false;                         ///< every value is a label, 0 the outside
  std::vector<LabelPair> between;                  ///< so too; only these interfaces
  std::optional<Border> border;                    ///< not given: open for shapes cut by their box
  Adjacency adjacency = Adjacency::interior;

  /// Whether the input is a label image.
  bool labelled() const { return all_labels || !between.empty(); }

  // how normals and operators are made
  Estimator estimator = Estimator::integral_invariant;
  bool estimator_given = false;
  BallCentre centre = BallCentre::surfel;
  std::optional<double> radius;  ///< world units
  bool projected = true;         ///< false: the naive calculus
  bool compare_naive = false;    ///< the result of the naive calculus too
  bool calculus_given = false;   ///< else a mesh file decides by its normals
  Stabilization stabilisation = Stabilization::de_goes;
  double lambda = 0.25;

  // what is computed
  bool regularise = false;                    ///< surface: smooth positions
  std::string function;                       ///< gradient, laplacian: an expression in x, y, z
  std::string rhs, fix;                       ///< poisson: expressions; fix may be empty
  std::vector<Vec3> sources;                  ///< the vertex nearest to each
  std::vector<std::int64_t> source_vertices;  ///< vertex ids
  std::optional<double> time;
  BoundaryChoice boundary = BoundaryChoice::mixed;
  DistanceMethod method = DistanceMethod::automatic;
  Index count = 10;  ///< spectrum: eigenvalues

  // curvature
  std::optional<CurvatureEstimator> curvature;  ///< not given: see curvature_estimator() in input.h
  CurvatureForm form = CurvatureForm::centred;
  bool on_vertices = false;     ///< ii: averages to vertices
  double curvature_lambda = 0;  ///< laplacian: 0 is no stabilisation

  // how pictures are drawn
  render::PictureOptions picture;
  std::string picture_field;  ///< empty: the first one of the result

  // how it is run and what is written
  std::vector<std::string> outputs;
  std::string report;
  int threads = 0;
  std::optional<Index> max_memory;  ///< bytes
  bool quiet = false;

  std::set<std::string> typed;  ///< the options that stand on the command line, as "--radius"
  bool given(const std::string& option) const { return typed.count(option) > 0; }
};

/// The command line, or the text that it asks for (--help, --version) instead.
struct CommandLine {
  Options options;
  std::optional<std::string> text;
};

/// \throws UsageError with a message that names the option and what it takes.
CommandLine parse_command_line(int argc, const char* const* argv);

/// The command's name as typed.
const char* name_of(Command command);
/// The estimator's name as typed.
const char* name_of(Estimator estimator);
/// The stabilisation's name as typed.
const char* name_of(Stabilization stabilisation);

}  // namespace dsc::cli
