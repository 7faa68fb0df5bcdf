/// \file
/// Bytes as base64 text.
#pragma once

#include <string>
#include <string_view>

namespace dsc::detail {

/// Appends the base64 form of `bytes`, padded where their number is no multiple of 3.
void append_base64(std::string& out, std::string_view bytes);

}  // namespace dsc::detail
