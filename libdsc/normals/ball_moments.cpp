#include "libdsc/normals/ball_moments.h"

#include "libdsc/base/error.h"
#include "libdsc/normals/ball_masks.h"
#include "libdsc/normals/continued_ball.h"
#include "libdsc/normals/row_scan.h"

#include <algorithm>

namespace dsc {
namespace {

__extension__ using Wide = __int128;

/// The same rounding, sooner where 64 bits hold it.
double to_double(Wide value) {
  const auto low = static_cast<Index>(value);
  return low == value ? static_cast<double>(low) : static_cast<double>(value);
}

}  // namespace

Mat3 covariance(const BallMoments& m, const Vec3& spacing) {
  if (m.count == 0) return Mat3::Zero();
  const auto entry = [&](std::size_t second, std::size_t a, std::size_t b) {
    const Wide centred = Wide{m.count} * m.second[second] - Wide{m.first[a]} * m.first[b];
    return to_double(centred) / static_cast<double>(m.count);
  };
  Mat3 v;
  v << entry(0, 0, 0), entry(3, 0, 1), entry(4, 0, 2),  //
      0, entry(1, 1, 1), entry(5, 1, 2),                //
      0, 0, entry(2, 2, 2);
  for (int a = 0; a < 3; ++a) {
    for (int b = a; b < 3; ++b) {
      v(a, b) *= 0.25 * spacing.prod() * spacing[a] * spacing[b];
      v(b, a) = v(a, b);
    }
  }
  return v;
}

BallScanner::BallScanner(const BinaryVolume& volume, double radius, Centres centres)
    : volume_(volume), ball_(radius, volume.grid().spacing) {
  if (centres == Centres::voxels) {
    rows_.emplace_back(ball_, Index3{0, 0, 0});
  } else {
    rows_.emplace_back(ball_, Index3{1, 0, 0});
    rows_.emplace_back(ball_, Index3{0, 1, 0});
    rows_.emplace_back(ball_, Index3{0, 0, 1});
  }
  for (const BallRows& rows : rows_) masks_.push_back(BallMasks::make(rows));
}

BallScanner::~BallScanner() = default;

std::size_t BallScanner::kind(const Index3& centre) const {
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    const Index3& parity = rows_[k].parity();
    if ((centre[0] & 1) == parity[0] && (centre[1] & 1) == parity[1] &&
        (centre[2] & 1) == parity[2]) {
      return k;
    }
  }
  throw UsageError("ball: the scanner was not built for centres of this kind (voxel or surfel)");
}

bool BallScanner::vectorised() const {
  return std::all_of(masks_.begin(), masks_.end(), [](const auto& m) { return m != nullptr; });
}

BallMoments BallScanner::operator()(const Index3& centre) const {
  const BallMasks* masks = masks_[kind(centre)].get();
  return masks != nullptr ? masks->moments(volume_, centre) : plain(centre);
}

BallMoments BallScanner::continued(const Index3& centre, bool& cut) const {
  const BallRows& rows = rows_[kind(centre)];
  cut = reaches_beyond(volume_.grid(), rows, centre);
  return cut ? continued_moments(volume_, rows, centre) : (*this)(centre);
}

BallMoments BallScanner::plain(const Index3& centre) const {
  const BallRows& rows = rows_[kind(centre)];
  const Index3& size = volume_.grid().size;
  BallMoments m;
  for (Index dz = -rows.reach(2); dz <= rows.reach(2); dz += 2) {
    const Index z = (centre[2] + dz) >> 1;
    if (z < 0 || z >= size[2]) continue;
    for (Index dy = -rows.reach(1); dy <= rows.reach(1); dy += 2) {
      const Index y = (centre[1] + dy) >> 1;
      const Index extent = rows.extent(dy, dz);
      if (extent < 0 || y < 0 || y >= size[1]) continue;
      const Index low = std::max<Index>((centre[0] - extent) >> 1, 0);
      const Index high = std::min((centre[0] + extent) >> 1, size[0] - 1);
      if (low > high) continue;
      const RowSums row = scan_row(volume_, low, high, y, z, centre[0]);
      add_row(m, row, dy, dz);
    }
  }
  return m;
}

}  // namespace dsc
