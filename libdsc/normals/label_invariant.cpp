#include "libdsc/normals/label_invariant.h"

#include "libdsc/base/parallel.h"
#include "libdsc/normals/continued_ball.h"
#include "libdsc/normals/flattest_direction.h"
#include "libdsc/normals/row_sums.h"

#include <atomic>
#include <string>

namespace dsc {
namespace {

/// Sums of one row of the ball, by whose voxels they are.
struct RowLabels {
  const LabelPair& labels;
  RowSums inside, outside;
  bool third = false;

  void add(Label label, Index start, Index n) {
    if (n <= 0) return;
    if (label == labels[0]) {
      add_run(inside, start, n);
    } else if (label == labels[1]) {
      add_run(outside, start, n);
    } else {
      third = true;
    }
  }
};

}  // namespace

InterfaceMoments interface_moments(const LabelVolume& volume, const LabelPair& labels,
                                   const BallRows& rows, const Index3& centre) {
  InterfaceMoments m;
  for (Index dz = -rows.reach(2); dz <= rows.reach(2); dz += 2) {
    for (Index dy = -rows.reach(1); dy <= rows.reach(1); dy += 2) {
      const Index extent = rows.extent(dy, dz);
      if (extent < 0) continue;
      const Index y = (centre[1] + dy) >> 1, z = (centre[2] + dz) >> 1;
      const Index low = (centre[0] - extent) >> 1, high = (centre[0] + extent) >> 1;
      RowLabels row{labels, {}, {}};
      Index start = low;
      Label running = volume(low, y, z);
      for (Index x = low + 1; x <= high + 1; ++x) {
        const Label here = x <= high ? volume(x, y, z) : running;
        if (x <= high && here == running) continue;
        row.add(running, 2 * start - centre[0], x - start);
        start = x;
        running = here;
      }
      add_row(m.inside, row.inside, dy, dz);
      add_row(m.outside, row.outside, dy, dz);
      m.third = m.third || row.third;
    }
  }
  return m;
}

InterfaceMoments continued_interface_moments(const LabelVolume& volume, const LabelPair& labels,
                                             const BallRows& rows, const Index3& centre) {
  const LabelPair swapped{labels[1], labels[0]};
  const auto inside_grid = [&](Index dx, Index dy, Index dz) {
    return volume.grid().contains((centre[0] + dx) >> 1, (centre[1] + dy) >> 1,
                                  (centre[2] + dz) >> 1);
  };
  const auto label = [&](Index dx, Index dy, Index dz) {
    return volume((centre[0] + dx) >> 1, (centre[1] + dy) >> 1, (centre[2] + dz) >> 1);
  };
  InterfaceMoments m;
  for (Index dz = -rows.reach(2); dz <= rows.reach(2); dz += 2) {
    for (Index dy = -rows.reach(1); dy <= rows.reach(1); dy += 2) {
      const Index extent = rows.extent(dy, dz);
      RowLabels row{labels, {}, {}}, mirrored{swapped, {}, {}};
      for (Index dx = -extent; dx <= extent; dx += 2) {
        if (inside_grid(dx, dy, dz)) {
          row.add(label(dx, dy, dz), dx, 1);
        } else if (inside_grid(-dx, -dy, -dz)) {
          mirrored.add(label(-dx, -dy, -dz), dx, 1);
        }
      }
      for (const RowLabels& part : {row, mirrored}) {
        add_row(m.inside, part.inside, dy, dz);
        add_row(m.outside, part.outside, dy, dz);
        m.third = m.third || part.third;
      }
    }
  }
  return m;
}

InterfaceNormals integral_invariant_normals(const LabelVolume& volume,
                                            std::span<const Surfel> surfels,
                                            std::span<const LabelPair> labels,
                                            const IntegralInvariantOptions& options,
                                            const Context& context) {
  if (labels.size() != surfels.size()) {
    throw UsageError("normals: " + std::to_string(labels.size()) + " label pairs for " +
                     std::to_string(surfels.size()) + " surfels");
  }
  if (options.centre != BallCentre::surfel) {
    throw UsageError("normals: on label volumes the ball is centred on the surfel");
  }
  const Vec3 spacing = volume.grid().spacing;
  const Ball ball(options.radius, spacing);
  const BallRows rows[3] = {BallRows(ball, {1, 0, 0}), BallRows(ball, {0, 1, 0}),
                            BallRows(ball, {0, 0, 1})};
  InterfaceNormals field;
  field.radius = options.radius;
  const auto n = static_cast<Index>(surfels.size());
  field.u.resize(3, n);
  context.begin("normals", n);
  struct Counts {
    Index third = 0, cut = 0;
  };
  const Counts counts = parallel_reduce(
      context, n, 256, Counts{},
      [&](Index first, Index last) {
        Counts found;
        for (Index i = first; i < last; ++i) {
          const Surfel& s = surfels[static_cast<std::size_t>(i)];
          const auto axis = static_cast<std::size_t>(s.axis());
          Index3 centre{2 * Index{s.x}, 2 * Index{s.y}, 2 * Index{s.z}};
          centre[axis] += s.sign();
          const bool cut = options.beyond == Beyond::continued &&
                           reaches_beyond(volume.grid(), rows[axis], centre);
          const InterfaceMoments m = (cut ? continued_interface_moments : interface_moments)(
              volume, labels[static_cast<std::size_t>(i)], rows[axis], centre);
          const Mat3 v = covariance(m.inside, spacing) + covariance(m.outside, spacing);
          field.u.col(i) = flattest_direction(v, s.normal());
          found.third += m.third ? 1 : 0;
          found.cut += cut ? 1 : 0;
        }
        context.advance(last - first);
        return found;
      },
      [](Counts a, Counts b) {
        return Counts{a.third + b.third, a.cut + b.cut};
      });
  field.third_label_faces = counts.third;
  field.cut_faces = counts.cut;
  fall_back(field, surfels, context);
  return field;
}

}  // namespace dsc
