#include "libdsc/surface/label_cells.h"

#include "libdsc/base/parallel.h"

namespace dsc {

LabelCells::LabelCells(const LabelVolume& volume, const Context& context) : volume_(volume) {
  const Index3 n = volume.grid().size;
  words_ = (n[0] + 2 + 63) / 64;
  rows_ = n[1] + 2;
  const Index total =
      checked_product(checked_product(words_, rows_, "label cells"), n[2] + 2, "label cells");
  check_allocation(checked_product(total, 3 * sizeof(Word), "label cells"),
                   "label surface: the cells of " + volume.grid().text());
  context.need("compare labels", total * static_cast<Index>(3 * sizeof(Word)));
  for (auto& bits : bits_) bits.assign(static_cast<std::size_t>(total), Word{0});

  context.begin("compare labels", n[2] + 1);
  parallel_for(context, n[2] + 1, 1, [&](Index z, Index) {
    const auto length = static_cast<std::size_t>(n[0]);
    std::vector<Label> here(length), below_y(length, 0), below_z(length);
    for (Index y = 0; y <= n[1]; ++y) {
      volume_.row(y, z, here.data());
      volume_.row(y, z - 1, below_z.data());
      const auto mark = [&](std::size_t axis, Index x) {
        const Index bit = x + 1;
        bits_[axis][at(bit >> 6, y, z)] |= Word{1} << (bit & 63);
      };
      Label before = 0;
      for (Index x = 0; x < n[0]; ++x) {
        const auto i = static_cast<std::size_t>(x);
        if (here[i] != before) mark(0, x);
        if (here[i] != below_y[i]) mark(1, x);
        if (here[i] != below_z[i]) mark(2, x);
        before = here[i];
      }
      if (before != 0) mark(0, n[0]);
      std::swap(here, below_y);
    }
    context.advance(1);
  });
}

}  // namespace dsc
