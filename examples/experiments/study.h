/// \file
/// What the experiments share: a digitized shape, norms of errors, tables in Markdown and curves in
/// CSV. Each program is called as PROGRAM [--full] [--out FOLDER] [DATA…].
#pragma once

#include "libdsc/io/results.h"
#include "libdsc/normals/radius.h"
#include "libdsc/normals/surface_normals.h"
#include "libdsc/render/picture.h"
#ifdef STUDY_WITH_PICTURES
#include "libdsc/render/png_file.h"
#endif
#include "libdsc/surface/digital_surface.h"
#include "libdsc/surface/extract.h"
#include "libdsc/voxels/digitize.h"
#include "libdsc/voxels/implicit_shape.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

namespace study {

/// The command line. At its end it says which files were written.
struct Arguments {
  bool full = false;  ///< the finest grids, too
  std::filesystem::path out = "out/experiments";
  std::vector<std::string> data;             ///< volume files, where the experiment takes any
  mutable std::vector<std::string> written;  ///< names of files in `out`

  Arguments(int argc, char** argv) {
    for (int i = 1; i < argc; ++i) {
      const std::string word = argv[i];
      if (word == "--full") {
        full = true;
      } else if (word == "--out" && i + 1 < argc) {
        out = argv[++i];
      } else if (word[0] != '-') {
        data.push_back(word);
      } else {
        std::fprintf(stderr, "usage: %s [--full] [--out FOLDER] [DATA...]\n", argv[0]);
        std::exit(2);
      }
    }
    std::filesystem::create_directories(out);
  }
  Arguments(const Arguments&) = delete;
  Arguments& operator=(const Arguments&) = delete;
  ~Arguments() {
    if (written.empty()) return;
    std::string list;
    for (const std::string& name : written) list += (list.empty() ? "" : ", ") + name;
    std::printf("\nWritten: %s.\n", list.c_str());
  }
};

/// Voxels and the surface around them, with integral invariant normals of r = 3 h^(1/2).
struct Digitized {
  dsc::BinaryVolume volume;
  dsc::DigitalSurface surface;
};

inline Digitized digitized(const dsc::ImplicitShape& shape, double h, double radius = 0) {
  dsc::BinaryVolume volume = dsc::digitize(shape, dsc::Vec3(h, h, h));
  dsc::DigitalSurface surface = dsc::extract_surface(volume);
  dsc::IntegralInvariantOptions options;
  options.radius = radius > 0 ? radius : dsc::shape_radius(h);
  dsc::integral_invariant_normals(surface, volume, options);
  return {std::move(volume), std::move(surface)};
}

/// Of absolute errors.
struct Norms {
  double mean = 0, rms = 0, max = 0;
};

inline Norms norms(const Eigen::ArrayXd& errors) {
  return {errors.abs().mean(), std::sqrt(errors.square().mean()), errors.abs().maxCoeff()};
}

/// The vertex nearest to p.
inline dsc::VertexId nearest(const dsc::FlatMesh& mesh, const dsc::Vec3& p) {
  dsc::Index v = 0;
  (mesh.positions.matrix().colwise() - p).colwise().squaredNorm().minCoeff(&v);
  return static_cast<dsc::VertexId>(v);
}

/// Distances on a sphere around the origin: from the vertex to all, taken at their directions.
inline Eigen::VectorXd great_circles(const dsc::FlatMesh& mesh, dsc::VertexId source) {
  const dsc::Vec3 p = mesh.positions[source];
  Eigen::VectorXd result(mesh.vertices());
  for (dsc::Index v = 0; v < result.size(); ++v) {
    const dsc::Vec3 q = mesh.positions[v];
    result[v] = std::atan2(p.cross(q).norm(), p.dot(q));
  }
  return result;
}

inline std::string text(double value, const char* format = "%.3g") {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

/// "mean (largest)" of the absolute errors.
inline std::string mean_and_max(const Eigen::ArrayXd& errors) {
  const Norms n = norms(errors);
  return text(n.mean) + " (" + text(n.max) + ")";
}

/// "root of the mean square (largest)".
inline std::string rms_and_max(const Eigen::ArrayXd& errors) {
  const Norms n = norms(errors);
  return text(n.rms) + " (" + text(n.max) + ")";
}

/// The calculus without stabilisation, λ_f = 0.
inline dsc::CalculusOptions mercat() {
  dsc::CalculusOptions options;
  options.stabilization = dsc::Stabilization::mercat;
  return options;
}

/// Writes FOLDER/NAME.vtp and, where dsc::render is built, a picture of each field as
/// FOLDER/NAME_FIELD.png.
inline void write(const Arguments& arguments, const std::string& name, const dsc::Result& result,
                  const dsc::render::PictureOptions& options = {}) {
  dsc::write_result((arguments.out / (name + ".vtp")).string(), result);
  arguments.written.push_back(name + ".vtp");
#ifdef STUDY_WITH_PICTURES
  for (const dsc::Field& field : result.fields) {
    const std::string picture = name + "_" + field.name + ".png";
    dsc::render::write_png((arguments.out / picture).string(),
                           dsc::render::draw(result.mesh, field, options).image);
    arguments.written.push_back(picture);
  }
#else
  static_cast<void>(options);
#endif
}

/// Seen from there (degrees); fields by one range, so that pictures beside each other compare.
inline dsc::render::PictureOptions seen(double azimuth, double elevation,
                                        std::optional<std::array<double, 2>> range = {}) {
  dsc::render::PictureOptions options;
  options.width = 1000;
  options.height = 800;
  options.view = {azimuth, elevation, "z"};
  options.range = range;
  return options;
}

/// From 0 to the largest finite value.
inline std::array<double, 2> from_zero(const Eigen::VectorXd& values) {
  return {0., values.array().isFinite().select(values.array(), 0.).maxCoeff()};
}

/// A table on stdout, and as a curve FOLDER/NAME.csv.
class Table {
 public:
  Table(const Arguments& arguments, const std::string& name, const std::vector<std::string>& heads)
      : csv_(arguments.out / (name + ".csv")) {
    arguments.written.push_back(name + ".csv");
    row(heads);
    std::string rule = "|";
    for (std::size_t i = 0; i < heads.size(); ++i) rule += " --- |";
    std::puts(rule.c_str());
  }
  void row(const std::vector<std::string>& cells) {
    std::string line = "|";
    for (std::size_t i = 0; i < cells.size(); ++i) {
      line += " " + cells[i] + " |";
      csv_ << (i == 0 ? "" : ",") << cells[i];
    }
    std::puts(line.c_str());
    std::fflush(stdout);
    csv_ << '\n';
  }

 private:
  std::ofstream csv_;
};

}  // namespace study
