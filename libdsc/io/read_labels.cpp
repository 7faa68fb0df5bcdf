#include "libdsc/io/read_labels.h"

#include "libdsc/base/error.h"
#include "libdsc/base/parallel.h"

#include <algorithm>
#include <optional>
#include <span>
#include <type_traits>

namespace dsc {
namespace {

template <class T>
bool is_label(T value) {
  if constexpr (std::is_floating_point_v<T>) {
    // The largest label is no float; the number after it is.
    return value >= 0 && value < T{0x1p32F} && static_cast<T>(static_cast<Label>(value)) == value;
  } else {
    return std::in_range<Label>(value);
  }
}

/// Where value i of a slab lies.
Index3 voxel_at(const Slab& slab, const Index3& size, bool x_fastest, Index i) {
  if (x_fastest) return {i % size[0], i / size[0] % size[1], slab.first + i / (size[0] * size[1])};
  return {slab.first + i / (size[2] * size[1]), i / size[2] % size[1], i % size[2]};
}

template <class T>
void check_labels(const VolumeSource& source, const Slab& slab, std::span<const T> values,
                  const Context& context) {
  const auto count = static_cast<Index>(values.size());
  const Index first_bad = parallel_reduce(
      context, count, 1 << 16, count,
      [&](Index first, Index last) {
        for (Index i = first; i < last; ++i) {
          if (!is_label(values[static_cast<std::size_t>(i)])) return i;
        }
        return count;
      },
      [](Index a, Index b) { return std::min(a, b); });
  if (first_bad == count) return;
  const Index3 at = voxel_at(slab, source.grid().size, source.x_fastest(), first_bad);
  throw InputError("'" + source.path() + "': voxel (" + std::to_string(at[0]) + ", " +
                   std::to_string(at[1]) + ", " + std::to_string(at[2]) + ") has the value " +
                   std::to_string(values[static_cast<std::size_t>(first_bad)]) +
                   "; labels are whole numbers from 0 to 4294967295");
}

template <class T>
void store(LabelVolume& volume, const VolumeSource& source, const Slab& slab,
           std::span<const T> values, const Context& context) {
  check_labels(source, slab, values, context);
  const Index3 size = volume.grid().size;
  const T* from = values.data();
  if (source.x_fastest()) {
    parallel_for(context, slab.last - slab.first, 1, [&](Index slice, Index) {
      for (Index y = 0; y < size[1]; ++y) {
        const T* row = from + (slice * size[1] + y) * size[0];
        for (Index x = 0; x < size[0]; ++x) {
          volume.set(x, y, slab.first + slice, static_cast<Label>(row[x]));
        }
      }
    });
  } else {
    parallel_for(context, size[2], 16, [&](Index first, Index last) {
      for (Index x = slab.first; x < slab.last; ++x) {
        for (Index y = 0; y < size[1]; ++y) {
          const T* row = from + ((x - slab.first) * size[1] + y) * size[2];
          for (Index z = first; z < last; ++z) volume.set(x, y, z, static_cast<Label>(row[z]));
        }
      }
    });
  }
}

}  // namespace

LabelVolume read_labels(VolumeSource& source, const Context& context) {
  std::optional<LabelVolume> volume;  // made with the first slab, which tells the width
  context.begin("read", source.grid().size[source.x_fastest() ? 2 : 0]);
  source.read(
      [&](const Slab& slab) {
        std::visit(
            [&](auto values) {
              using T = std::remove_cv_t<typename decltype(values)::element_type>;
              if (!volume) {
                const int width = std::min<int>(4, sizeof(T));
                context.need("read", LabelVolume::bytes_for(source.grid(), width));
                volume.emplace(source.grid(), width);
              }
              store<T>(*volume, source, slab, values, context);
            },
            slab.values);
      },
      context);
  return volume ? std::move(*volume) : LabelVolume(source.grid(), 1);
}

LabelVolume read_labels(const std::string& path, const Context& context) {
  return read_labels(*open_volume(path, context), context);
}

}  // namespace dsc
