/// \file
/// \internal
/// The page without its data, put together at build time from the files of this folder.
/// Private to page/.
#pragma once

#include <string_view>

namespace dsc::detail {

/// The page up to its title, from there to its data, and what follows.
extern const std::string_view kPageHead, kPageBody, kPageTail;
/// three.js, as the system has it.
extern const std::string_view kThreeJs;

}  // namespace dsc::detail
