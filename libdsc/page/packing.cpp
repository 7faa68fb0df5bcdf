#include "libdsc/page/packing.h"

#include <algorithm>
#include <memory>
#include <new>

#include <zlib.h>

namespace dsc::detail {

std::string byte_planes(std::span<const std::int32_t> values, std::size_t components) {
  const std::size_t n = values.size() / components;
  std::string planes(4 * values.size(), '\0');
  for (std::size_t c = 0; c < components; ++c) {
    char* to = planes.data() + c * n;
    std::uint32_t before = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const auto value = static_cast<std::uint32_t>(values[i * components + c]);
      const std::uint32_t d = value - before;
      const std::uint32_t z = (d << 1) ^ (0U - (d >> 31));
      for (std::size_t byte = 0; byte < 4; ++byte) {
        to[byte * values.size() + i] = static_cast<char>(z >> (8 * byte) & 255U);
      }
      before = value;
    }
  }
  return planes;
}

std::string deflated(std::string_view bytes, const Context& context) {
  // Streamed, so that it can be cancelled.
  z_stream stream{};
  if (deflateInit(&stream, 6) != Z_OK) throw std::bad_alloc();
  const std::unique_ptr<z_stream, int (*)(z_stream*)> end(
      &stream, [](z_stream* s) { return deflateEnd(s); });
  std::string out;
  out.reserve(deflateBound(&stream, bytes.size()));  // what is not written takes no memory
  std::string buffer(std::size_t{1} << 16, '\0');
  constexpr std::size_t kMost = std::size_t{1} << 20;  // 50 ms
  std::size_t done = 0;
  int state = Z_OK;
  while (state != Z_STREAM_END) {
    context.check();
    const std::size_t count = std::min(kMost, bytes.size() - done);
    // zlib does not write to its input, though its type says so.
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data() + done));
    stream.avail_in = static_cast<uInt>(count);
    done += count;
    const int flush = done == bytes.size() ? Z_FINISH : Z_NO_FLUSH;
    do {
      stream.next_out = reinterpret_cast<Bytef*>(buffer.data());
      stream.avail_out = static_cast<uInt>(buffer.size());
      state = deflate(&stream, flush);
      out.append(buffer.data(), buffer.size() - stream.avail_out);
    } while (stream.avail_out == 0);
  }
  return out;
}

std::string packed(std::span<const std::int32_t> values, std::size_t components,
                   const Context& context) {
  return deflated(byte_planes(values, components), context);
}

}  // namespace dsc::detail
