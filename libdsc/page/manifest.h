/// \file
/// \internal
/// What the page has to know about its blocks, as JSON. Private to page/.
#pragma once

#include "libdsc/io/results.h"

#include <string>
#include <string_view>
#include <vector>

namespace dsc::detail {

struct Manifest {
  std::string title;
  int sides = 0;         ///< corners of every face; 0: they differ, and there is a block `sizes`
  bool lattice = false;  ///< the three of PagePositions
  Vec3 origin = Vec3::Zero(), step{1., 1., 1.};
  std::vector<int> exponents;  ///< of PageValues, one a field
};

/// All but the title and what the arrays tell.
Manifest manifest_of(const Result& result);

std::string json_of(const Manifest& page, const Result& result);

/// For the inside of an HTML element.
std::string escaped_text(std::string_view text);

}  // namespace dsc::detail
