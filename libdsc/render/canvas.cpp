#include "libdsc/render/canvas.h"

#include "libdsc/render/stroke_font.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace dsc::render {
namespace {

using Point = Eigen::Vector2d;

double distance(const Point& p, const Segment& s) {
  const Point along = s.second - s.first;
  const double length = along.squaredNorm();
  const double t = length > 0 ? std::clamp((p - s.first).dot(along) / length, 0., 1.) : 0.;
  return (p - s.first - t * along).norm();
}

}  // namespace

double Canvas::text_width(const std::string& text) const { return unit_ * stroked(text).width; }

void Canvas::blend(int x, int y, const Rgb& colour, double part) {
  if (part <= 0 || x < 0 || y < 0 || x >= image_.width || y >= image_.height) return;
  Pixel& pixel = image_.at(x, y);
  pixel = pixel_of((1 - part) * rgb_of(pixel) + part * colour);
}

void Canvas::fill(const Rectangle& area, const Rgb& colour) {
  const double right = area.left + area.width, bottom = area.top + area.height;
  const auto covered = [](int pixel, double from, double to) {
    return std::clamp(std::min(to, pixel + 1.) - std::max(from, double(pixel)), 0., 1.);
  };
  for (int y = static_cast<int>(std::floor(area.top)); y < bottom; ++y) {
    for (int x = static_cast<int>(std::floor(area.left)); x < right; ++x) {
      blend(x, y, colour, covered(x, area.left, right) * covered(y, area.top, bottom));
    }
  }
}

void Canvas::stroke(std::span<const Segment> pieces, double width, const Rgb& colour) {
  Eigen::AlignedBox2d box;
  for (const Segment& s : pieces) box.extend(s.first).extend(s.second);
  if (box.isEmpty()) return;
  const double reach = width / 2 + 1;
  for (int y = static_cast<int>(box.min()[1] - reach); y <= box.max()[1] + reach; ++y) {
    for (int x = static_cast<int>(box.min()[0] - reach); x <= box.max()[0] + reach; ++x) {
      const Point p(x + 0.5, y + 0.5);
      double nearest = reach;
      for (const Segment& s : pieces) nearest = std::min(nearest, distance(p, s));
      blend(x, y, colour, std::clamp(width / 2 - nearest + 0.5, 0., 1.));
    }
  }
}

void Canvas::text(double left, double base, const std::string& text, const Rgb& colour) {
  // Letter by letter, so that a pixel looks at few strokes.
  double x = 0;
  std::string before;
  for (const char sign : text) {
    StrokedText letter = stroked(std::string(1, sign));
    before += sign;
    x = stroked(before).width - letter.width;
    for (auto& [a, b] : letter.segments) {
      for (Point* p : {&a, &b}) {
        *p = Point(left + unit_ * ((*p)[0] + x), base - unit_ * (*p)[1]);
      }
    }
    stroke(letter.segments, std::max(1.1, 0.85 * unit_), colour);
  }
}

void Canvas::triangle(const std::array<Point, 3>& corners, const Rgb& colour) {
  Eigen::AlignedBox2d box;
  for (const Point& corner : corners) box.extend(corner);
  constexpr int kFine = 4;
  const auto side = [](const Point& a, const Point& b, const Point& p) {
    return (b - a)[0] * (p - a)[1] - (b - a)[1] * (p - a)[0];
  };
  const bool turned = side(corners[0], corners[1], corners[2]) < 0;
  for (int y = static_cast<int>(box.min()[1]); y <= box.max()[1]; ++y) {
    for (int x = static_cast<int>(box.min()[0]); x <= box.max()[0]; ++x) {
      int inside = 0;
      for (int k = 0; k < kFine * kFine; ++k) {
        const Point p(x + (k % kFine + 0.5) / kFine, y + (k / kFine + 0.5) / kFine);
        bool all = true;
        for (std::size_t i = 0; i < 3; ++i) {
          const double s = side(corners[i], corners[(i + 1) % 3], p);
          all = all && (turned ? s <= 0 : s >= 0);
        }
        inside += all ? 1 : 0;
      }
      blend(x, y, colour, static_cast<double>(inside) / (kFine * kFine));
    }
  }
}

}  // namespace dsc::render
