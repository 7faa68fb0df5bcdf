/// \file
/// A picture as bytes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace dsc::render {

/// Red, green and blue of sRGB, a byte each.
using Pixel = std::array<std::uint8_t, 3>;

/// Rows from the top, pixels from the left.
struct Image {
  int width = 0;              ///< pixels of a row
  int height = 0;             ///< rows
  std::vector<Pixel> pixels;  ///< width × height

  /// No pixel.
  Image() = default;
  /// All of one colour.
  Image(int w, int h, Pixel colour = {255, 255, 255})
      : width(w),
        height(h),
        pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), colour) {}

  /// x from the left, y from the top.
  /// @{
  Pixel& at(int x, int y) { return pixels[index(x, y)]; }
  const Pixel& at(int x, int y) const { return pixels[index(x, y)]; }
  /// @}

  /// The same size and the same pixels.
  friend bool operator==(const Image&, const Image&) = default;

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
};

}  // namespace dsc::render
