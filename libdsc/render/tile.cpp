#include "libdsc/render/tile.h"

#include "libdsc/render/isolines.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace dsc::render {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
// Neighbours in the picture belong together where no more depth lies between them than a steep
// surface has in a pixel, or a step of a staircase whose riser looks away: 1 / sin 20° = 2.9 edges,
// or 2.1 diagonals, lie behind it from the default elevation.
constexpr double kSteep = 12, kStair = 2.5;
const Rgb kBackground(1, 1, 1);

/// A point of the picture, traced.
struct Point {
  Rgb colour = kBackground;
  double value = kNone;
  double depth = -std::numeric_limits<double>::infinity();
  double size = 0;  ///< of the face, pixels from corner to opposite corner
};

/// From the axes of pixels, y down, to those that light has.
Vec3 upright(const Vec3& v) { return {v[0], -v[1], v[2]}; }

/// The unit normal of the triangle or quad that was hit, towards the viewer.
Vec3 flat_normal(const Hit& hit, std::span<const VertexId> corners, const Tracer& tracer) {
  const auto corner = [&](std::size_t i) {
    return tracer.position(corners[static_cast<std::size_t>(hit.slot[i])]);
  };
  const bool quad = hit.slot[3] >= 0;
  const Vec3 n =
      (corner(2) - corner(0)).cross(quad ? corner(3) - corner(1) : corner(2) - corner(1));
  const double length = n.norm();
  if (!(length > 0)) return Vec3::UnitZ();
  return upright(n[2] < 0 ? Vec3(-n / length) : Vec3(n / length));
}

double extent(const Hit& hit, std::span<const VertexId> corners, const Tracer& tracer) {
  const auto corner = [&](std::size_t i) {
    return tracer.position(corners[static_cast<std::size_t>(hit.slot[i])]);
  };
  return (corner(2) - corner(0)).norm();
}

double light_on(const Scene& scene, const Hit& hit, std::span<const VertexId> corners) {
  Vec3 normal;
  if (scene.true_normals) {
    normal = upright(scene.camera.turned(scene.mesh.normals[hit.face]));
    if (!hit.front) normal = -normal;
  } else {
    normal = flat_normal(hit, corners, scene.surface);
  }
  return scene.lighting(normal);
}

Point trace(const Scene& scene, double x, double y) {
  Point point;
  const Hit hit = scene.surface(x, y);
  if (hit) {
    const auto corners = scene.mesh.face(hit.face);
    const Coat coat = scene.paint.at(hit, corners);
    point = {coat.colour * light_on(scene, hit, corners), coat.value, hit.depth,
             extent(hit, corners, scene.surface)};
  }
  return point;
}

/// An arrow where it lies before the surface; it hides lines, too.
bool cover_by_arrow(const Scene& scene, double x, double y, Point& point) {
  if (scene.arrow_tracer == nullptr) return false;
  const Hit hit = (*scene.arrow_tracer)(x, y);
  if (!hit || hit.depth < point.depth) return false;
  static const Rgb colour = rgb_of(lab_of_hue(0.25, 0.02, 270));
  const Vec3 normal = flat_normal(hit, scene.arrows->face(hit.face), *scene.arrow_tracer);
  point.colour = colour * (0.6 + 1.2 * scene.lighting(normal));
  return true;
}

/// The weights of the points of a pixel and its eight neighbours in its mean, by how near they are
/// to its centre: a tent two pixels wide, which lets less moiré through than the pixel's own
/// square.
std::vector<double> tent(const std::vector<Eigen::Vector2d>& points) {
  std::vector<double> weights;
  double sum = 0;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      for (const Eigen::Vector2d& p : points) {
        const double x = std::abs(dx + p[0] - 0.5), y = std::abs(dy + p[1] - 0.5);
        weights.push_back(std::max(0., 1 - x) * std::max(0., 1 - y));
        sum += weights.back();
      }
    }
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

}  // namespace

std::vector<Eigen::Vector2d> sample_points(int count) {
  // The additive sequence of the plastic number's powers: even for any count.
  constexpr double kPlastic = 1.32471795724474602596;
  std::vector<Eigen::Vector2d> points;
  for (int k = 0; k < count; ++k) {
    const double x = 0.5 + k / kPlastic, y = 0.5 + k / (kPlastic * kPlastic);
    points.emplace_back(x - std::floor(x), y - std::floor(y));
  }
  return points;
}

void draw_tile(const Scene& scene, int left, int top, int right, int bottom, Image& image) {
  const int n = static_cast<int>(scene.points.size());
  constexpr int kAround = 2;  // pixels: the filter reaches one further, lines another
  const int width = right - left + 2 * kAround, height = bottom - top + 2 * kAround;
  std::vector<Point> traced(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                            static_cast<std::size_t>(n));
  const auto index = [&](int x, int y, int k) {
    const auto pixel =
        static_cast<std::size_t>(y - top + kAround) * static_cast<std::size_t>(width) +
        static_cast<std::size_t>(x - left + kAround);
    return pixel * static_cast<std::size_t>(n) + static_cast<std::size_t>(k);
  };
  const auto for_each = [&](int around, auto&& action) {
    for (int y = top - around; y < bottom + around; ++y) {
      for (int x = left - around; x < right + around; ++x) {
        for (int k = 0; k < n; ++k) action(x, y, k);
      }
    }
  };
  const int around = scene.isoline_step > 0 ? kAround : 1;
  for_each(around, [&](int x, int y, int k) {
    const Eigen::Vector2d& p = scene.points[static_cast<std::size_t>(k)];
    traced[index(x, y, k)] = trace(scene, x + p[0], y + p[1]);
  });

  const double soft = 1 / std::sqrt(static_cast<double>(n));
  const auto line = [&](int x, int y, int k, const Point& here) {
    const auto beside = [&](int dx, int dy) {
      const Point& other = traced[index(x + dx, y + dy, k)];
      const double step = std::max(kSteep, kStair * std::min(here.size, other.size));
      return std::abs(other.depth - here.depth) < step ? other.value : kNone;
    };
    const bool zero = scene.zero_line && std::abs(here.value) < scene.isoline_step / 2;
    return line_coverage({here.value, beside(-1, 0), beside(1, 0), beside(0, -1), beside(0, 1)},
                         scene.isoline_step, scene.line_width * (zero ? 2 : 1), soft);
  };
  // Values and depths stay for the neighbours' lines; colours become final.
  for_each(1, [&](int x, int y, int k) {
    Point& here = traced[index(x, y, k)];
    const Eigen::Vector2d& p = scene.points[static_cast<std::size_t>(k)];
    if (cover_by_arrow(scene, x + p[0], y + p[1], here)) return;
    if (!(scene.isoline_step > 0) || std::isnan(here.value)) return;
    const double part = scene.line_strength * line(x, y, k, here);
    here.colour = (1 - part) * here.colour + part * scene.line_colour;
  });

  const std::vector<double> weights = tent(scene.points);
  for (int y = top; y < bottom; ++y) {
    for (int x = left; x < right; ++x) {
      Rgb sum(0, 0, 0);
      auto weight = weights.begin();
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          for (int k = 0; k < n; ++k) sum += *weight++ * traced[index(x + dx, y + dy, k)].colour;
        }
      }
      image.at(x, y) = pixel_of(sum);
    }
  }
}

}  // namespace dsc::render
