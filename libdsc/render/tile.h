/// \file
/// \internal
/// A tile of the picture: its points traced, lit, crossed by isolines, and averaged to pixels.
#pragma once

#include "libdsc/render/camera.h"
#include "libdsc/render/image.h"
#include "libdsc/render/lighting.h"
#include "libdsc/render/paint.h"
#include "libdsc/render/tracer.h"

#include <vector>

namespace dsc::render {

/// All that a tile needs to know; nothing here changes while tiles are drawn.
struct Scene {
  const FlatMesh& mesh;
  const Tracer& surface;
  const Paint& paint;
  const Camera& camera;
  Lighting lighting;
  bool true_normals = false;
  const FlatMesh* arrows = nullptr;  ///< and their tracer; null: none
  const Tracer* arrow_tracer = nullptr;
  double isoline_step = 0;
  double line_width = 1;  ///< pixels
  Rgb line_colour{0, 0, 0};
  double line_strength = 0.85;
  bool zero_line = false;               ///< whether the line of 0 is wider
  std::vector<Eigen::Vector2d> points;  ///< where a pixel is sampled, in it
};

/// `count` points of the unit square that fill it evenly.
std::vector<Eigen::Vector2d> sample_points(int count);

/// Draws the pixels [left, right) × [top, bottom) of the image.
void draw_tile(const Scene& scene, int left, int top, int right, int bottom, Image& image);

}  // namespace dsc::render
