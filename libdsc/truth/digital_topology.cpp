#include "libdsc/truth/digital_topology.h"

#include "libdsc/base/error.h"
#include "libdsc/base/parallel.h"
#include "libdsc/solve/components.h"
#include "libdsc/surface/extract.h"
#include "libdsc/truth/snap.h"
#include "libdsc/voxels/digitize.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace dsc::truth {
namespace {

/// Points of a cloud, taken only where no other is nearer than a distance.
class Thinning {
 public:
  explicit Thinning(double distance) : distance_(distance) {}

  bool take(const Vec3& p) {
    const Eigen::Matrix<Index, 3, 1> cell = (p / distance_).array().floor().cast<Index>();
    for (Index z = -1; z <= 1; ++z) {
      for (Index y = -1; y <= 1; ++y) {
        for (Index x = -1; x <= 1; ++x) {
          const auto range = cells_.find({cell.x() + x, cell.y() + y, cell.z() + z});
          if (range == cells_.end()) continue;
          for (const Vec3& q : range->second) {
            if ((p - q).norm() < distance_) return false;
          }
        }
      }
    }
    cells_[{cell.x(), cell.y(), cell.z()}].push_back(p);
    return true;
  }

 private:
  double distance_;
  std::map<Index3, std::vector<Vec3>> cells_;
};

/// \throws InputError where f < 0 at a point of the box's sides, so that they cut the shape.
void check_sides(const ImplicitShape& shape) {
  const Eigen::AlignedBox3d box = shape.bounds();
  const double tolerance = 1e-9 * box.diagonal().norm();
  constexpr int kSteps = 64;
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i <= kSteps; ++i) {
      for (int j = 0; j <= kSteps; ++j) {
        for (const Vec3& corner : {box.min(), box.max()}) {
          Vec3 p = corner;
          const int u = (axis + 1) % 3;
          const int v = (axis + 2) % 3;
          p[u] = box.min()[u] + box.sizes()[u] * i / kSteps;
          p[v] = box.min()[v] + box.sizes()[v] * j / kSteps;
          // A shape may touch its box, up to rounding.
          if (shape.value(p) < -tolerance * shape.gradient(p).norm()) {
            throw InputError(fmt::format(
                "smooth mesh: {} reaches the side of its box at ({}, {}, {}); choose a larger box",
                shape.name(), p.x(), p.y(), p.z()));
          }
        }
      }
    }
  }
}

}  // namespace

Index surface_euler_number(const BinaryVolume& volume, const Context& context) {
  const auto& size = volume.grid().size;
  const Index euler = parallel_reduce(
      context, size[2], 1, Index{0},
      [&](Index first, Index last) {
        Index sum = 0;
        for (Index z = first; z < last; ++z) {
          for (Index y = 0; y < size[1]; ++y) {
            // The column of four voxels at x, bit (dz, dy), and the one before it.
            unsigned before = 0;
            for (Index x = 0; x < size[0]; ++x) {
              const unsigned here = (volume.in_margin(x, y, z) ? 1u : 0u) |
                                    (volume.in_margin(x, y + 1, z) ? 2u : 0u) |
                                    (volume.in_margin(x, y, z + 1) ? 4u : 0u) |
                                    (volume.in_margin(x, y + 1, z + 1) ? 8u : 0u);
              const auto cells = [](unsigned m) {  // voxel - pairs + square, as of corner (0, 0)
                return Index((m & 1u) == 1u) - Index((m & 3u) == 3u) - Index((m & 5u) == 5u) +
                       Index((m & 15u) == 15u);
              };
              sum += cells(here) - cells(here & before);
              before = here;
            }
          }
        }
        return sum;
      },
      [](Index a, Index b) { return a + b; });
  return 2 * euler;
}

DigitalTopology digital_topology(const ImplicitShape& shape, const Context& context) {
  if (!shape.closed()) {
    throw UsageError("smooth mesh: " + shape.name() +
                     " is not closed, its box cuts it; choose a closed shape");
  }
  check_sides(shape);
  const double extent = shape.bounds().sizes().maxCoeff();
  DigitalTopology coarse;
  for (const double cells : {48., 96., 192., 384.}) {
    const double h = extent / cells;
    const BinaryVolume volume = digitize(shape, Vec3::Constant(h), context);
    DigitalSurface surface = extract_surface(volume, {}, context);
    DigitalTopology fine;
    fine.gridstep = h;
    fine.components = surface.counts().components;
    fine.euler = surface_euler_number(volume, context);
    if (fine.components > 0 && fine.components == coarse.components && fine.euler == coarse.euler) {
      coarse.surface = std::move(surface);
      return coarse;
    }
    coarse = std::move(fine);
  }
  if (coarse.components == 0) {
    throw InputError("smooth mesh: no lattice point of gridstep " +
                     std::to_string(coarse.gridstep) + " is inside " + shape.name() +
                     "; it is empty or too thin");
  }
  throw SolverError("smooth mesh: the digitizations of " + shape.name() + " down to gridstep " +
                    std::to_string(coarse.gridstep) +
                    " do not agree on its components and Euler number; it is too thin there");
}

Eigen::Matrix3Xd surface_seeds(const ImplicitShape& shape, const DigitalTopology& digital,
                               double spacing) {
  const DigitalSurface& surface = digital.surface;
  const Components components = connected_components(surface.flat(false));
  std::vector<Eigen::AlignedBox3d> boxes(static_cast<std::size_t>(components.count()));
  for (VertexId v = 0; v < surface.vertex_count(); ++v) {
    boxes[static_cast<std::size_t>(components.of_vertex[static_cast<std::size_t>(v)])].extend(
        surface.position(v));
  }
  std::vector<Thinning> thinned;
  for (const auto& box : boxes) {
    thinned.emplace_back(std::min(spacing, 0.25 * box.diagonal().norm()));
  }
  // In a scattered order: in the raster's, the points would come to lie in rows.
  const Index n = surface.vertex_count();
  Index stride = static_cast<Index>(0.6180339887 * static_cast<double>(n)) | 1;
  while (std::gcd(stride, n) != 1) stride += 2;
  std::vector<Vec3> points;
  for (Index i = 0, v = 0; i < n; ++i, v = (v + stride) % n) {
    const auto component = components.of_vertex[static_cast<std::size_t>(v)];
    Vec3 p = surface.position(static_cast<VertexId>(v));
    if (!snap_to_surface(shape, 1.5 * digital.gridstep, p)) continue;  // others will
    if (thinned[static_cast<std::size_t>(component)].take(p)) points.push_back(p);
  }
  Eigen::Matrix3Xd seeds(3, static_cast<Index>(points.size()));
  for (std::size_t k = 0; k < points.size(); ++k) seeds.col(static_cast<Index>(k)) = points[k];
  return seeds;
}

}  // namespace dsc::truth
