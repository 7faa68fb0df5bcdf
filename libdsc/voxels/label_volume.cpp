#include "libdsc/voxels/label_volume.h"

#include "libdsc/base/parallel.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <string>

namespace dsc {
namespace {

template <class T>
std::vector<T> zeros(const Grid& grid) {
  try {
    return std::vector<T>(static_cast<std::size_t>(grid.voxels()), T{0});
  } catch (const std::exception&) {  // bad_alloc or length_error
    throw LimitError("label volume: no memory for the labels of " + grid.text());
  }
}

}  // namespace

Index LabelVolume::bytes_for(const Grid& grid, int bytes) {
  grid.check();
  return checked_product(grid.voxels(), bytes, "label volume bytes");
}

LabelVolume::LabelVolume(const Grid& grid, int bytes) : grid_(grid) {
  check_allocation(bytes_for(grid, bytes), "label volume: " + grid.text());
  switch (bytes) {
    case 1:
      labels_ = zeros<std::uint8_t>(grid);
      break;
    case 2:
      labels_ = zeros<std::uint16_t>(grid);
      break;
    case 4:
      labels_ = zeros<std::uint32_t>(grid);
      break;
    default:
      throw UsageError("label volume: a label takes 1, 2 or 4 bytes, not " + std::to_string(bytes));
  }
}

Label LabelVolume::largest() const {
  return std::visit(
      [](const auto& values) -> Label {
        return std::numeric_limits<typename std::decay_t<decltype(values)>::value_type>::max();
      },
      labels_);
}

void LabelVolume::set(Index x, Index y, Index z, Label label) {
  std::visit(
      [&](auto& values) {
        using T = typename std::decay_t<decltype(values)>::value_type;
        values[index(x, y, z)] = static_cast<T>(label);
      },
      labels_);
}

void LabelVolume::row(Index y, Index z, Label* out) const {
  const auto n = static_cast<std::size_t>(grid_.size[0]);
  if (y < 0 || z < 0 || y >= grid_.size[1] || z >= grid_.size[2]) {
    std::fill_n(out, n, Label{0});
    return;
  }
  std::visit([&](const auto& values) { std::copy_n(values.data() + index(0, y, z), n, out); },
             labels_);
}

Index LabelVolume::count(const Context& context) const {
  return std::visit(
      [&](const auto& values) {
        return parallel_reduce(
            context, static_cast<Index>(values.size()), 1 << 18, Index{0},
            [&](Index first, Index last) {
              const auto zeros = std::count(values.begin() + first, values.begin() + last, 0);
              return last - first - static_cast<Index>(zeros);
            },
            [](Index a, Index b) { return a + b; });
      },
      labels_);
}

std::vector<Label> LabelVolume::labels(const Context& context) const {
  using Set = std::vector<Label>;
  const Index slice = grid_.size[0] * grid_.size[1];
  Set found = parallel_reduce(
      context, grid_.size[2], 1, Set{},
      [&](Index z, Index) {
        Set here;
        std::visit(
            [&](const auto& values) {
              const auto* begin = values.data() + z * slice;
              Label last = 0;
              for (Index i = 0; i < slice; ++i) {
                if (begin[i] == last || begin[i] == 0) continue;
                last = begin[i];
                const auto at = std::lower_bound(here.begin(), here.end(), last);
                if (at == here.end() || *at != last) here.insert(at, last);
              }
            },
            labels_);
        return here;
      },
      [](const Set& a, const Set& b) {
        Set both;
        std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
        return both;
      });
  return found;
}

BinaryVolume LabelVolume::select(std::span<const Label> labels, const Context& context) const {
  std::vector<Label> wanted(labels.begin(), labels.end());
  std::sort(wanted.begin(), wanted.end());
  BinaryVolume result(grid_);
  parallel_for(context, grid_.size[2], 1, [&](Index z, Index) {
    std::vector<Label> values(static_cast<std::size_t>(grid_.size[0]));
    for (Index y = 0; y < grid_.size[1]; ++y) {
      row(y, z, values.data());
      for (Index x = 0; x < grid_.size[0]; ++x) {
        if (std::binary_search(wanted.begin(), wanted.end(), values[static_cast<std::size_t>(x)])) {
          result.set(x, y, z);
        }
      }
    }
  });
  return result;
}

std::size_t LabelVolume::memory_bytes() const {
  return std::visit([](const auto& values) { return values.size() * sizeof(values[0]); }, labels_);
}

}  // namespace dsc
