/// \file
/// \internal
/// Drawing flat things on an image: rectangles, lines, text, with smooth edges.
#pragma once

#include "libdsc/render/camera.h"
#include "libdsc/render/color.h"

#include <span>
#include <string>

namespace dsc::render {

class Canvas {
 public:
  /// `unit` pixels are a seventh of the height of a capital; strokes are about as thick.
  Canvas(Image& image, double unit) : image_(image), unit_(unit) {}

  double unit() const { return unit_; }
  double text_width(const std::string& text) const;

  void fill(const Rectangle& area, const Rgb& colour);
  /// Of straight pieces, as one stroke.
  void stroke(std::span<const std::pair<Eigen::Vector2d, Eigen::Vector2d>> pieces, double width,
              const Rgb& colour);
  /// With its left end and its base line there.
  void text(double left, double base, const std::string& text, const Rgb& colour);
  /// A filled triangle.
  void triangle(const std::array<Eigen::Vector2d, 3>& corners, const Rgb& colour);

 private:
  void blend(int x, int y, const Rgb& colour, double part);

  Image& image_;
  double unit_;
};

}  // namespace dsc::render
