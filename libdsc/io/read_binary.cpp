#include "libdsc/io/read_binary.h"

#include "libdsc/base/error.h"
#include "libdsc/base/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <type_traits>

namespace dsc {
namespace {

using Word = BinaryVolume::Word;

/// Sets the bits of a slab whose values run along x. Rows are cut where the words of the volume
/// are: bit b of word w is x = 64 w + b - 1.
template <class T, class Inside>
void pack_along_x(BinaryVolume& volume, const Slab& slab, std::span<const T> values,
                  const Inside& inside, const Context& context) {
  const Index3 size = volume.grid().size;
  const bool zero_is_outside = !inside(T{0});
  parallel_for(context, slab.last - slab.first, 1, [&](Index first, Index last) {
    for (Index slice = first; slice < last; ++slice) {
      for (Index y = 0; y < size[1]; ++y) {
        const T* row = values.data() + (slice * size[1] + y) * size[0];
        for (Index w = 0; w < volume.words_per_row(); ++w) {
          const Index begin = std::max<Index>(0, 64 * w - 1);
          const Index end = std::min(size[0], 64 * w + 63);
          if (begin >= end) continue;
          const T* block = row + begin;
          const Index count = end - begin;
          if (zero_is_outside) {
            if constexpr (std::is_integral_v<T>) {  // others are seldom all 0
              T any = 0;
              for (Index k = 0; k < count; ++k) any = static_cast<T>(any | block[k]);
              if (any == 0) continue;
            }
          }
          Word word = 0;
          for (Index k = 0; k < count; ++k) word |= static_cast<Word>(inside(block[k])) << k;
          if (word != 0) volume.set_word(w, y, slab.first + slice, word << (begin - (64 * w - 1)));
        }
      }
    }
  });
}

/// The same for a slab whose values run along z, its slices of constant x. Threads own ranges of z.
template <class T, class Inside>
void pack_along_z(BinaryVolume& volume, const Slab& slab, std::span<const T> values,
                  const Inside& inside, const Context& context) {
  const Index3 size = volume.grid().size;
  parallel_for(context, size[2], 16, [&](Index first, Index last) {
    for (Index x = slab.first; x < slab.last; ++x) {
      for (Index y = 0; y < size[1]; ++y) {
        const T* row = values.data() + ((x - slab.first) * size[1] + y) * size[2];
        for (Index z = first; z < last; ++z) {
          if (inside(row[z])) volume.set(x, y, z);
        }
      }
    }
  });
}

template <class T, class Inside>
void pack(BinaryVolume& volume, bool along_x, const Slab& slab, std::span<const T> values,
          const Inside& inside, const Context& context) {
  if (along_x) {
    pack_along_x(volume, slab, values, inside, context);
  } else {
    pack_along_z(volume, slab, values, inside, context);
  }
}

/// The integers of type T in [low, high]; empty (first > last) where there are none.
template <class T>
std::pair<T, T> integers_in(double low, double high) {
  using Limits = std::numeric_limits<T>;
  // 2^bits is exact as a double, the largest T may not be.
  const double beyond = std::ldexp(1., Limits::digits);
  const double least = std::is_signed_v<T> ? -beyond : 0.;
  const double a = std::ceil(low);
  const double b = std::floor(high);
  if (a >= beyond || b < least || a > b) return {T{1}, T{0}};
  return {a <= least ? Limits::min() : static_cast<T>(a),
          b >= beyond ? Limits::max() : static_cast<T>(b)};
}

template <class T>
bool equals(T value, std::int64_t label) {
  // A label that a double cannot hold, no float holds.
  const auto rounded = static_cast<double>(label);
  return std::abs(rounded) < 0x1p63 && static_cast<std::int64_t>(rounded) == label &&
         static_cast<double>(value) == rounded;
}

/// select() for floats. NaN is in no interval, equals no label, and is no object.
template <class T>
void select_floats(BinaryVolume& volume, bool along_x, const Slab& slab, std::span<const T> values,
                   const VoxelSelection& selection, const Context& context) {
  if (selection.threshold) {
    const auto [low, high] = *selection.threshold;
    pack(
        volume, along_x, slab, values,
        [low = low, high = high](T v) { return v >= low && v <= high; }, context);
  } else if (selection.labels.empty()) {
    pack(
        volume, along_x, slab, values, [](T v) { return v < 0 || v > 0; }, context);
  } else {
    pack(
        volume, along_x, slab, values,
        [&](T v) {
          return std::any_of(selection.labels.begin(), selection.labels.end(),
                             [&](std::int64_t label) { return equals(v, label); });
        },
        context);
  }
}

template <class T>
void select(BinaryVolume& volume, bool along_x, const Slab& slab, std::span<const T> values,
            const VoxelSelection& selection, const Context& context) {
  if (selection.threshold) {
    const auto [low, high] = integers_in<T>(selection.threshold->low, selection.threshold->high);
    if (low > high) return;
    pack(
        volume, along_x, slab, values,
        [low = low, high = high](T v) { return v >= low && v <= high; }, context);
    return;
  }
  if (selection.labels.empty()) {
    pack(
        volume, along_x, slab, values, [](T v) { return v != 0; }, context);
    return;
  }
  std::vector<T> labels;  // those that T can hold
  for (const std::int64_t label : selection.labels) {
    if (std::in_range<T>(label)) labels.push_back(static_cast<T>(label));
  }
  std::sort(labels.begin(), labels.end());
  if (labels.empty()) return;
  if (labels.size() == 1) {
    pack(
        volume, along_x, slab, values, [label = labels[0]](T v) { return v == label; }, context);
  } else {
    pack(
        volume, along_x, slab, values,
        [&](T v) { return std::binary_search(labels.begin(), labels.end(), v); }, context);
  }
}

}  // namespace

void VoxelSelection::check() const {
  if (threshold && !labels.empty()) {
    throw UsageError("a threshold and labels cannot be given together; choose one");
  }
  if (threshold && !(threshold->low <= threshold->high)) {
    throw UsageError("the threshold LO,HI must be numbers with LO <= HI");
  }
}

VoxelSelection VoxelSelection::completed(VolumeClass volume_class) const {
  VoxelSelection selection = *this;
  if (threshold || !labels.empty()) return selection;
  constexpr double kEnd = std::numeric_limits<double>::infinity();
  constexpr double kLeast = std::numeric_limits<double>::denorm_min();
  if (volume_class == VolumeClass::level_set) selection.threshold = {-kEnd, -kLeast};
  if (volume_class == VolumeClass::fog_volume) selection.threshold = {kLeast, kEnd};
  return selection;
}

BinaryVolume read_binary(VolumeSource& source, const VoxelSelection& given,
                         const Context& context) {
  given.check();
  const VoxelSelection selection = given.completed(source.volume_class());
  context.need("read", BinaryVolume::bytes_for(source.grid()));
  BinaryVolume volume(source.grid());
  context.begin("read", source.grid().size[source.x_fastest() ? 2 : 0]);
  source.read(
      [&](const Slab& slab) {
        std::visit(
            [&](auto values) {
              using T = std::remove_cv_t<typename decltype(values)::element_type>;
              if constexpr (std::is_floating_point_v<T>) {
                select_floats<T>(volume, source.x_fastest(), slab, values, selection, context);
              } else {
                select<T>(volume, source.x_fastest(), slab, values, selection, context);
              }
            },
            slab.values);
      },
      context);
  return volume;
}

BinaryVolume read_binary(const std::string& path, const VoxelSelection& selection,
                         const Context& context) {
  selection.check();
  return read_binary(*open_volume(path, context), selection, context);
}

}  // namespace dsc
