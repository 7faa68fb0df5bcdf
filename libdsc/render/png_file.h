/// \file
/// Images as PNG files.
#pragma once

#include "libdsc/render/image.h"

#include <string>

namespace dsc::render {

/// The bytes of a PNG file of 8-bit sRGB. \throws OutputError where libpng refuses.
std::string png_bytes(const Image& image);

/// Writes the file whole or not at all (AtomicFile). \throws OutputError.
void write_png(const std::string& path, const Image& image);

}  // namespace dsc::render
