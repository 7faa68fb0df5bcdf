/// \file
/// What the experiments share: a digitized shape, norms of errors, tables in Markdown and curves in
/// CSV. Each program is called as PROGRAM [--full] [--out FOLDER] [DATA…].
#pragma once

#include "libdsc/io/results.h"
#include "libdsc/normals/radius.h"
#include "libdsc/normals/surface_normals.h"
#include "libdsc/surface/digital_surface.h"
#include "libdsc/surface/extract.h"
#include "libdsc/voxels/digitize.h"
#include "libdsc/voxels/implicit_shape.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace study {

/// The command line.
struct Arguments {
  bool full = false;  ///< the finest grids, too
  std::filesystem::path out = "out/experiments";
  std::vector<std::string> data;  ///< volume files, where the experiment takes any

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

inline std::string text(double value, const char* format = "%.3g") {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

/// A table on stdout, and as a curve FOLDER/NAME.csv.
class Table {
 public:
  Table(const Arguments& arguments, const std::string& name, const std::vector<std::string>& heads)
      : csv_(arguments.out / (name + ".csv")) {
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
