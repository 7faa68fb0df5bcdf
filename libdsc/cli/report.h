/// \file
/// What a run found out about itself: the content of --report FILE.json and of the summary.
#pragma once

#include "libdsc/cli/options.h"
#include "libdsc/cli/statistics.h"
#include "libdsc/surface/digital_surface.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dsc::cli {

struct InputReport {
  std::string name;  ///< the file, or the shape with all its parameters
  Index3 size{0, 0, 0};
  Vec3 spacing{1., 1., 1.};
  Vec3 origin{0., 0., 0.};            ///< world position of the centre of voxel (0, 0, 0)
  Mat3 direction = Mat3::Identity();  ///< columns: the world directions of the volume's axes
  Index inside = 0;                   ///< voxels
  std::string grid;                   ///< of a .vdb file: its name
  VolumeClass volume_class = VolumeClass::values;
  bool chosen = false;          ///< which values are inside was said on the command line
  std::optional<Index> labels;  ///< of a label image: how many labels occur, 0 left out
};

/// "level set" or "fog volume"; "" for others.
const char* name_of(VolumeClass volume_class);
/// Which values are inside where the class decides: "value < 0", "value > 0", "value != 0".
const char* inside_of(VolumeClass volume_class);

/// Of a mesh file, in place of InputReport.
struct MeshInputReport {
  std::string name;
  bool normals = false;  ///< whether it has normals for the projected calculus
  Index isolated_vertices = 0;
  std::vector<std::string> fields;  ///< their names
};

struct NormalsReport {
  std::string estimator;
  double radius = 0;    ///< world units; 0 where the estimator has none
  Index fallbacks = 0;  ///< faces whose estimate had to be replaced
  Index cut_faces = 0;  ///< faces whose ball was continued beyond the volume
  /// Of a label image: faces whose ball meets a label beyond their own two.
  std::optional<Index> third_label_faces;
};

struct CalculusReport {
  bool projected = true;
  std::string stabilisation;     ///< as typed
  std::optional<double> lambda;  ///< where it is one number for all faces
  Index clamped_faces = 0;
};

/// The positions that functions are sampled at and curvature is taken from.
struct PositionsReport {
  std::string kind;  ///< projected, regularised, pointels, or as given (of a mesh)
  /// How far the vertices moved, world units, and the iterations; regularised only.
  std::optional<double> mean_displacement, largest_displacement;
  std::optional<Index> iterations;
};

struct PoissonReport {
  Index fixed_vertices = 0;      ///< with a given value
  Index free_components = 0;     ///< without one (with mercat: parities); mean zero there
  double removed_mean = 0;       ///< the largest that was taken from the right-hand side of one
  double relative_residual = 0;  ///< of the linear system
};

/// How distances came about (GeodesicReport has the same in the library).
struct HeatReport {
  double time = 0;  ///< of the heat step, length squared
  bool time_raised = false;
  std::string method;  ///< direct or bands
  Index components_without_source = 0;
  Index flat_faces = 0;       ///< without a direction
  Index negative_faces = 0;   ///< with heat below zero at a corner
  Index raised_vertices = 0;  ///< set to 0, since they came out below
  double lowest_value = 0;    ///< the lowest of these, in length
  double heat_residual = 0, poisson_residual = 0;
  Index poisson_iterations = 0;
};

struct SpectrumReport {
  std::vector<double> eigenvalues;  ///< ascending
  double residual = 0;              ///< as in Spectrum
  Index rounds = 0;
  std::optional<Index> checkerboards;  ///< left out below the last one, where there may be any
};

/// Of a .png output.
struct PictureReport {
  std::string path;
  std::string field;         ///< what is shown, as its key says; empty: the surface alone
  std::string colormap;      ///< empty: no scalar is shown
  double low = 0, high = 0;  ///< the ends of its colour bar
  double isoline_step = 0;   ///< 0: no isolines
  Index infinite = 0;        ///< values drawn grey
};

/// Wall-clock seconds; 0 for a stage that was not needed. The stages sum to the total, but for what
/// lies between them. `check` measures results, against known answers where there are any.
struct Timings {
  double read = 0, extract = 0, normals = 0, smooth = 0, assemble = 0, factorize = 0, solve = 0,
         check = 0, write = 0;
  double total = 0;
};

struct Report {
  std::optional<InputReport> input;
  std::optional<MeshInputReport> mesh_input;
  std::optional<SurfaceCounts> surface;
  std::optional<NormalsReport> normals;
  std::optional<CalculusReport> calculus;
  std::optional<SpectrumReport> spectrum;
  std::optional<PositionsReport> positions;
  std::optional<PoissonReport> poisson;
  std::optional<HeatReport> heat;
  std::vector<std::int64_t> source_vertices;
  std::string result_name;  ///< the quantity that `result` is about
  std::optional<Statistics> result;
  std::string error_name;  ///< what `error` measures
  std::optional<ErrorNorms> error;
  std::vector<std::pair<std::string, ErrorNorms>> further_errors;  ///< of other quantities
  std::vector<std::string> warnings;
  std::vector<std::string> outputs;
  std::vector<PictureReport> pictures;
  Timings timings;
  Index peak_memory_bytes = 0;
};

/// The peak resident memory of this process so far, in bytes.
Index peak_memory_bytes();

/// Writes the report as JSON, whole or not at all; numbers that JSON cannot hold become null.
/// \throws OutputError.
void write_report(const std::string& path, const Options& options, const Report& report);

/// The short, aligned text for stdout.
std::string summary(const Report& report);

}  // namespace dsc::cli
