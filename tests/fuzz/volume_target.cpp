#include "tests/fuzz/volume_target.h"

#include "libdsc/base/error.h"
#include "libdsc/io/read_binary.h"
#include "libdsc/io/read_labels.h"
#include "libdsc/io/volume_writer.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/pipe_file.h"

#include <cmath>
#include <cstring>
#include <map>
#include <optional>
#include <type_traits>
#include <variant>
#include <vector>

namespace dsc::fuzz {
namespace {

using Values =
    std::variant<std::vector<std::uint8_t>, std::vector<std::int8_t>, std::vector<std::uint16_t>,
                 std::vector<std::int16_t>, std::vector<std::uint32_t>, std::vector<std::int32_t>,
                 std::vector<std::uint64_t>, std::vector<std::int64_t>, std::vector<float>,
                 std::vector<double>>;

/// The values, x fastest whatever the file's order, and checks of the slabs that bring them.
Values read_values(VolumeSource& source) {
  const Index3 size = source.grid().size;
  const bool along_x = source.x_fastest();
  const Index slices = along_x ? size[2] : size[0];
  const Index per_slice = size[1] * (along_x ? size[0] : size[2]);
  std::optional<Values> all;
  Index next = 0;
  source.read(
      [&](const Slab& slab) {
        require(slab.first == next && slab.last > slab.first && slab.last <= slices,
                "slabs come one after another");
        next = slab.last;
        std::visit(
            [&](auto values) {
              using T = std::remove_cv_t<typename decltype(values)::element_type>;
              require(std::ssize(values) == (slab.last - slab.first) * per_slice, "slabs are full");
              if (!all) all = std::vector<T>(static_cast<std::size_t>(slices * per_slice));
              auto& to = std::get<std::vector<T>>(*all);
              for (Index i = 0; i < std::ssize(values); ++i) {
                Index at = slab.first * per_slice + i;
                if (!along_x) {
                  const Index z = at % size[2], y = at / size[2] % size[1];
                  at = at / (size[2] * size[1]) + size[0] * (y + size[1] * z);
                }
                to[static_cast<std::size_t>(at)] = values[static_cast<std::size_t>(i)];
              }
            },
            slab.values);
      },
      kContext);
  require(next == slices, "no slab is missing");
  return *all;
}

/// Calls check(value, x, y, z) for every voxel.
template <class Check>
void for_each(const Values& values, const Index3& size, const Check& check) {
  std::visit(
      [&](const auto& v) {
        std::size_t i = 0;
        for (Index z = 0; z < size[2]; ++z) {
          for (Index y = 0; y < size[1]; ++y) {
            for (Index x = 0; x < size[0]; ++x) check(v[i++], x, y, z);
          }
        }
      },
      values);
}

void check_bits_and_labels(const OpenVolume& open, const Values& values, const Index3& size) {
  const BinaryVolume bits = read_binary(*open(), {}, kContext);
  for_each(values, size, [&](auto value, Index x, Index y, Index z) {
    require(bits(x, y, z) == (value < 0 || value > 0), "a bit is set where the value is not 0");
  });
  bool all_labels = true;
  for_each(values, size, [&](auto value, Index, Index, Index) {
    const auto v = static_cast<long double>(value);
    all_labels = all_labels && v >= 0 && v <= 4294967295.L && v == std::floor(v);
  });
  std::optional<LabelVolume> labels;
  try {
    labels = read_labels(*open(), kContext);
  } catch (const InputError&) {
  }
  require(labels.has_value() == all_labels, "labels are whole numbers of 32 bits");
  if (!labels) return;
  for_each(values, size, [&](auto value, Index x, Index y, Index z) {
    require(static_cast<long double>((*labels)(x, y, z)) == static_cast<long double>(value),
            "a label is the value");
  });
}

bool same_bits(const Values& a, const Values& b) {
  return a.index() == b.index() &&
         std::visit(
             [&](const auto& x) {
               const auto& y = std::get<std::decay_t<decltype(x)>>(b);
               return x.size() == y.size() &&
                      std::memcmp(x.data(), y.data(), x.size() * sizeof x[0]) == 0;
             },
             a);
}

}  // namespace

void check_volume_reader(
    const OpenVolume& open, const std::string& ending,
    const std::function<std::unique_ptr<VolumeSource>(std::string_view bytes)>& reopen) {
  constexpr Index kMost = Index{1} << 12;
  const auto source = open();
  const Grid grid = source->grid();
  grid.check();
  for (const Index size : grid.size) require(size > 0, "sizes are positive");
  if (grid.voxels() > kMost) return;
  const Values values = read_values(*source);
  check_bits_and_labels(open, values, grid.size);
  if (ending.empty()) return;

  static std::map<std::string, std::unique_ptr<PipeFile>> pipes;
  std::unique_ptr<PipeFile>& pipe = pipes[ending];
  if (pipe == nullptr) pipe = std::make_unique<PipeFile>(ending);
  const VoxelValues view =
      std::visit([](const auto& v) -> VoxelValues { return std::span(v); }, values);
  // Compression takes most of the time; now and then is enough.
  const VolumeWriteOptions options{.compress = grid.voxels() % 32 == 0};
  write_volume(pipe->path(), grid, view, options, kContext);
  const auto again = reopen(pipe->take());
  require(again->grid().size == grid.size, "sizes are read back");
  require(ending == ".npy" || again->grid().spacing == grid.spacing, "spacings are read back");
  require(same_bits(read_values(*again), values), "values are read back");
}

}  // namespace dsc::fuzz
