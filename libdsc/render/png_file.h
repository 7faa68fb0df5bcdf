/// \file
/// Images as PNG files.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/render/image.h"

#include <string>

namespace dsc::render {

/// The bytes of a PNG file of 8-bit sRGB. \throws OutputError where libpng refuses; LimitError.
std::string png_bytes(const Image& image, const Context& context = {});

/// Writes the file whole or not at all (AtomicFile); libpng's work cannot be cancelled.
/// \throws as png_bytes(); OutputError.
void write_png(const std::string& path, const Image& image, const Context& context = {});

}  // namespace dsc::render
