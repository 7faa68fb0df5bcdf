/// \file
/// \internal
/// The colour maps of a page, as textures of 256 entries. Private to page/.
#pragma once

#include <string>
#include <vector>

namespace dsc::detail {

struct Palette {
  std::string name;
  bool diverging = false;  ///< whether the middle stands for 0
  std::string hex;         ///< 256 times red, green, blue of sRGB, two digits each
};

/// The first is for values of one sign, the first diverging one for signed values; the last, named
/// `labels`, has 256 colours to tell neighbouring labels apart.
std::vector<Palette> page_palettes();

}  // namespace dsc::detail
