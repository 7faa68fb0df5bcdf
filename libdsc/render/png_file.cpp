#include "libdsc/render/png_file.h"

#include "libdsc/base/error.h"
#include "libdsc/io/atomic_file.h"

#include <png.h>

namespace dsc::render {

// libpng's simplified interface keeps errors in `control.message` and prints nothing.
std::string png_bytes(const Image& image, const Context& context) {
  png_image control{};
  control.version = PNG_IMAGE_VERSION;
  control.width = static_cast<png_uint_32>(image.width);
  control.height = static_cast<png_uint_32>(image.height);
  control.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(control);
  context.need("write", static_cast<Index>(size));
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&control, bytes.data(), &size, 0, image.pixels.data(), 0,
                                nullptr) == 0) {
    throw OutputError(std::string("the picture cannot be made a PNG file: ") + control.message);
  }
  bytes.resize(size);
  return bytes;
}

void write_png(const std::string& path, const Image& image, const Context& context) {
  context.begin("write");
  const std::string bytes = png_bytes(image, context);
  context.check();
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

}  // namespace dsc::render
