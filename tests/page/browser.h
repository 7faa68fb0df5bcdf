/// \file
/// Opens pages in a browser without a window.
#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace dsc::test {

/// Whether there is a browser; if not, what to install.
bool has_browser();
inline constexpr const char* kNoBrowser = "no Chromium (Debian: chromium)";

/// What the page at `path` says of itself with #selftest and further wishes in its address, as
/// "theme=dark&shading=none". \throws std::runtime_error where it says nothing.
nlohmann::json self_test(const std::string& path, const std::string& wishes = "");

}  // namespace dsc::test
