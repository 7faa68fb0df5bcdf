#include "libdsc/render/glyphs.h"

#include "libdsc/base/parallel.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dsc::render {
namespace {

constexpr int kSides = 12;

struct Place {
  Vec3 point, vector, normal;  ///< in the axes of the picture
};

/// The normal of the face that is seen, towards the viewer.
Vec3 normal_at(const Hit& hit, std::span<const VertexId> corners, const Tracer& surface) {
  const auto corner = [&](std::size_t i) {
    return surface.position(corners[static_cast<std::size_t>(hit.slot[i])]);
  };
  const Vec3 n = (corner(1) - corner(0)).cross(corner(2) - corner(0));
  const double length = n.norm();
  if (!(length > 0)) return Vec3::UnitZ();
  return n[2] < 0 ? Vec3(-n / length) : Vec3(n / length);
}

Vec3 vector_at(const Field& vectors, const Hit& hit, std::span<const VertexId> corners) {
  const auto of = [&](Index i) {
    const double* v = vectors.values.data() + 3 * i;
    return Vec3(v[0], v[1], v[2]);
  };
  if (vectors.on == FieldOn::face) return of(hit.face);
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < 4 && hit.slot[i] >= 0; ++i) {
    sum += hit.weight[i] * of(corners[static_cast<std::size_t>(hit.slot[i])]);
  }
  return sum;
}

/// Pixels of `area` where the surface is seen, by a coarse grid.
double seen_area(const Tracer& surface, const Rectangle& area, const Context& context) {
  constexpr double kPitch = 4;
  const auto rows = static_cast<Index>(area.height / kPitch);
  return kPitch * kPitch *
         parallel_reduce(
             context, rows, 8, 0.,
             [&](Index first, Index last) {
               double count = 0;
               for (Index r = first; r < last; ++r) {
                 for (double x = kPitch / 2; x < area.width; x += kPitch) {
                   const double y = area.top + (static_cast<double>(r) + 0.5) * kPitch;
                   count += surface(area.left + x, y) ? 1 : 0;
                 }
               }
               return count;
             },
             [](double a, double b) { return a + b; });
}

void add_arrow(const Vec3& from, const Vec3& vector, double thickness, ArrowMesh& to) {
  const double length = vector.norm();
  const Vec3 axis = vector / length;
  const Vec3 a = axis.unitOrthogonal(), b = axis.cross(a);
  const double head = std::min(0.55 * length, 4.2 * thickness);
  const double radius = std::min(thickness, 0.4 * head);
  const auto first = static_cast<VertexId>(to.positions.size() / 3);
  const auto put = [&](const Vec3& p) {
    to.positions.insert(to.positions.end(), p.begin(), p.end());
  };
  // Rings: the tail, the neck, the rim of the head; then the middles of tail and rim, and the tip.
  const double at[3] = {0, length - head, length - head};
  const double wide[3] = {radius, radius, 2.2 * radius};
  for (int ring = 0; ring < 3; ++ring) {
    for (int k = 0; k < kSides; ++k) {
      const double angle = 2 * std::numbers::pi * k / kSides;
      put(from + at[ring] * axis + wide[ring] * (std::cos(angle) * a + std::sin(angle) * b));
    }
  }
  put(from);
  put(from + length * axis);
  const VertexId tail = first + 3 * kSides, tip = tail + 1;
  const auto triangle = [&](VertexId p, VertexId q, VertexId r) {
    to.corners.insert(to.corners.end(), {p, q, r});
    to.offsets.push_back(static_cast<Index>(to.corners.size()));
  };
  for (int k = 0; k < kSides; ++k) {
    const auto on = [&](int ring, int i) {
      return static_cast<VertexId>(first + ring * kSides + i % kSides);
    };
    triangle(tail, on(0, k + 1), on(0, k));
    triangle(on(0, k), on(0, k + 1), on(1, k + 1));
    triangle(on(0, k), on(1, k + 1), on(1, k));
    triangle(on(1, k), on(1, k + 1), on(2, k + 1));
    triangle(on(1, k), on(2, k + 1), on(2, k));
    triangle(on(2, k), on(2, k + 1), tip);
  }
}

/// The length that one in twenty exceeds: a few outliers must not shrink all the rest.
double usual_length(const std::vector<Place>& places) {
  std::vector<double> lengths;
  for (const Place& place : places) lengths.push_back(place.vector.stableNorm());
  const auto rank = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() * 19 / 20);
  std::nth_element(lengths.begin(), rank, lengths.end());
  return *rank > 0 ? *rank : std::max(1., *std::max_element(lengths.begin(), lengths.end()));
}

}  // namespace

FlatMesh ArrowMesh::view() const {
  FlatMesh mesh;
  mesh.positions = {positions.data(), static_cast<Index>(positions.size() / 3)};
  mesh.corners = corners;
  mesh.offsets = offsets;
  return mesh;
}

ArrowMesh make_arrows(const FlatMesh& mesh, const Field& vectors, int count, const Tracer& surface,
                      const Camera& camera, const Rectangle& area, const Context& context) {
  ArrowMesh arrows;
  arrows.offsets.push_back(0);
  const double seen = seen_area(surface, area, context);
  if (count < 1 || seen <= 0) return arrows;
  const double step = std::sqrt(seen / count * 2 / std::sqrt(3.));
  std::vector<Place> places;
  const double row_height = step * std::sqrt(3.) / 2;
  for (int row = 0; (row + 0.5) * row_height < area.height; ++row) {
    const double y = area.top + (row + 0.5) * row_height;
    for (double x = (row % 2 == 0 ? 0.25 : 0.75) * step; x < area.width; x += step) {
      const Hit hit = surface(area.left + x, y);
      if (!hit) continue;
      const auto corners = mesh.face(hit.face);
      Vec3 v = camera.turned(vector_at(vectors, hit, corners));
      if (!v.allFinite()) continue;
      places.push_back({{area.left + x, y, hit.depth}, v, normal_at(hit, corners, surface)});
    }
  }
  if (places.empty()) return arrows;
  // Points and triangles here and in their tracer, a box around each triangle: measured.
  context.need("draw", 13000 * std::ssize(places));
  const double usual = usual_length(places);
  const double thickness = std::max(0.8, 0.05 * step);
  for (const Place& place : places) {
    const Vec3 vector = 1.5 * step * place.vector / usual;
    if (!(vector.norm() > 0.5)) continue;  // not half a pixel long
    add_arrow(place.point + 2.3 * thickness * place.normal, vector, thickness, arrows);
  }
  return arrows;
}

}  // namespace dsc::render
