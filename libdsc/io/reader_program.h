/// \file
/// \internal
/// What the programs that read volumes for the library have in common: their limits, their
/// messages, and how an image goes through the pipe (image_stream.h). They do not link the library.
#pragma once

#include "libdsc/io/image_stream.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

namespace dsc::detail {

/// Why an image cannot be read; its message goes to stderr.
class ImageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// It is larger than memory or than what can be counted.
class ImageTooLarge : public ImageError {
 public:
  using ImageError::ImageError;
};

/// Gets the next bytes of the values.
using TakeBytes = std::function<void(const void* bytes, std::size_t count)>;

/// An image as such a program sees it: its header first, then its values in pieces.
class Image {
 public:
  Image() = default;
  Image(const Image&) = delete;
  Image& operator=(const Image&) = delete;
  virtual ~Image() = default;
  /// Its name_bytes are set by who sends it.
  virtual ImageHeader header() const = 0;
  /// The name of the part of the file that it is, where the file holds several.
  virtual std::string part() const { return {}; }
  virtual void read(const TakeBytes& take) = 0;
};

/// What is asked for on the command line.
struct ImageRequest {
  std::string path;
  std::optional<std::string> part;  ///< of a file that holds several volumes
  std::size_t bytes = 0;            ///< memory that may be taken
};

struct ReaderMain {
  const char* usage;  ///< for who starts it by hand
  bool takes_part;    ///< whether files hold several volumes
  std::function<std::unique_ptr<Image>(const ImageRequest&)> open;
  /// The message of an exception that open() or Image::read() let through.
  std::function<std::string(const std::exception&)> message;
};

/// main() of `NAME FILE [BYTES [PART]]`: the image to a pipe on standard output, in so much memory.
/// \return 0; on failure, with one line on stderr, 1, or 4 where the image is too large.
int run_reader(const ReaderMain& reader, int argc, char** argv);

}  // namespace dsc::detail
