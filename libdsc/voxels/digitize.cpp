#include "libdsc/voxels/digitize.h"

#include "libdsc/base/parallel.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

namespace dsc {
namespace {

/// The lattice indices of an axis: [first, last] in the bounds, and the margin around them.
struct LatticeRange {
  Index first[3];
  Index last[3];
  Index margin;
};

LimitError too_fine(const ImplicitShape& shape, const Vec3& spacing, const std::string& into) {
  std::ostringstream text;
  text << "digitization: gridstep " << spacing[0];
  if (!(spacing.array() == spacing[0]).all()) text << "," << spacing[1] << "," << spacing[2];
  text << " cuts " << shape.name() << " into " << into << "; use a larger one";
  return LimitError(text.str());
}

LatticeRange lattice_range(const ImplicitShape& shape, const Vec3& spacing) {
  constexpr double kMostVoxels = 2147483648.;  // 2^31: positions h i stay exact far beyond
  const Eigen::AlignedBox3d box = shape.bounds();
  LatticeRange range;
  range.margin = shape.closed() ? 1 : 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double h = spacing[axis];
    if (!(h > 0) || !std::isfinite(h)) {
      throw UsageError("digitization: the gridstep must be positive and finite, not " +
                       std::to_string(h));
    }
    const double first = std::ceil(box.min()[axis] / h - 1e-9);
    const double last = std::floor(box.max()[axis] / h + 1e-9);
    if (!(std::abs(first) < kMostVoxels && std::abs(last) < kMostVoxels &&
          last - first < kMostVoxels)) {
      throw too_fine(shape, spacing, "more than 2^31 voxels along an axis");
    }
    range.first[axis] = static_cast<Index>(first);
    range.last[axis] = static_cast<Index>(last);
  }
  return range;
}

Grid grid_of(const LatticeRange& range, const Vec3& spacing) {
  Grid grid;
  grid.spacing = spacing;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    grid.size[a] = std::max<Index>(0, range.last[axis] - range.first[axis] + 1) + 2 * range.margin;
    grid.origin[axis] = spacing[axis] * static_cast<double>(range.first[axis] - range.margin);
  }
  return grid;
}

}  // namespace

Grid digitization_grid(const ImplicitShape& shape, const Vec3& spacing) {
  const Grid grid = grid_of(lattice_range(shape, spacing), spacing);
  try {
    check_allocation(grid.voxels() / 8, "");
  } catch (const LimitError&) {
    throw too_fine(shape, spacing, grid.text() + ", more than memory holds");
  }
  return grid;
}

BinaryVolume digitize(const ImplicitShape& shape, const Vec3& spacing, const Context& context) {
  const LatticeRange range = lattice_range(shape, spacing);
  const Grid grid = digitization_grid(shape, spacing);
  context.need("digitize", BinaryVolume::bytes_for(grid));
  BinaryVolume volume(grid);
  const Index margin = range.margin;
  const Index x_end = grid.size[0] - margin;
  context.begin("digitize", grid.size[2]);
  parallel_for(context, grid.size[2] - 2 * margin, 1, [&](Index first, Index last) {
    double values[64];
    for (Index z = first + margin; z < last + margin; ++z) {
      const double pz = spacing[2] * static_cast<double>(range.first[2] - margin + z);
      for (Index y = margin; y < grid.size[1] - margin; ++y) {
        const double py = spacing[1] * static_cast<double>(range.first[1] - margin + y);
        for (Index w = 0; w < volume.words_per_row(); ++w) {
          const Index x0 = 64 * w - 1;  // bit b of the word is voxel x0 + b
          const Index begin = std::max<Index>(margin, x0);
          const Index end = std::min<Index>(x_end, x0 + 64);
          if (begin >= end) continue;
          const int count = static_cast<int>(end - begin);
          shape.values_along_x(spacing[0], range.first[0] - margin + begin, count, py, pz, values);
          BinaryVolume::Word word = 0;
          for (int k = 0; k < count; ++k) {
            word |= static_cast<BinaryVolume::Word>(values[k] < 0) << k;
          }
          if (word != 0) volume.set_word(w, y, z, word << (begin - x0));
        }
      }
      context.advance(1);
    }
  });
  return volume;
}

}  // namespace dsc
