/// \file
/// Opens pages in a browser without a window.
#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace dsc::test {

/// Whether there is a browser; if not, what to install.
bool has_browser();
inline constexpr const char* kNoBrowser = "no Chromium (Debian: chromium)";

/// So that machines without a graphics card draw the same.
inline constexpr const char* kSoftwareWebGl = "--use-angle=swiftshader --enable-unsafe-swiftshader";

/// What the page at `path` says of itself with #selftest and further wishes in its address, as
/// "theme=dark&shading=none". \throws std::runtime_error where it says nothing.
nlohmann::json self_test(const std::string& path, const std::string& wishes = "");

/// Whether drive() can be used: it needs node too; if not, what to install.
bool can_drive();
inline constexpr const char* kNoDriver = "no Chromium or no node (Debian: chromium, nodejs)";

/// {results, errors} of the steps that drive.js describes, in a browser of these flags.
/// \throws std::runtime_error where a step fails.
nlohmann::json drive(const nlohmann::json& steps, const std::string& flags = kSoftwareWebGl);

}  // namespace dsc::test
