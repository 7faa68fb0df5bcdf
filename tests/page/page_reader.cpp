#include "tests/page/page_reader.h"

#include "tests/io/temporary_folder.h"

#include <stdexcept>

#include <zlib.h>

namespace dsc::test {

std::string bytes_of_base64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  if (text.size() % 4 != 0) throw std::runtime_error("base64 of no whole group");
  std::string bytes;
  for (std::size_t i = 0; i < text.size(); i += 4) {
    std::uint32_t group = 0;
    int count = 3;
    for (std::size_t k = 0; k < 4; ++k) {
      const char c = text[i + k];
      const auto digit = c == '=' ? 0 : digits.find(c);
      if (digit == std::string::npos) throw std::runtime_error("no base64");
      if (c == '=') --count;
      group = group << 6 | static_cast<std::uint32_t>(digit);
    }
    for (int k = 0; k < count; ++k) bytes += static_cast<char>(group >> (16 - 8 * k) & 255);
  }
  return bytes;
}

std::string inflated(const std::string& bytes) {
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) throw std::runtime_error("zlib");
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  std::string out, buffer(1 << 16, '\0');
  int state = Z_OK;
  while (state == Z_OK) {
    stream.next_out = reinterpret_cast<Bytef*>(buffer.data());
    stream.avail_out = static_cast<uInt>(buffer.size());
    state = inflate(&stream, Z_NO_FLUSH);
    out.append(buffer.data(), buffer.size() - stream.avail_out);
  }
  const bool whole = state == Z_STREAM_END && stream.avail_in == 0;
  inflateEnd(&stream);
  if (!whole) throw std::runtime_error("no zlib stream");
  return out;
}

std::vector<std::int32_t> unpacked(const std::string& block, std::size_t components) {
  const std::string planes = inflated(block);
  const std::size_t total = planes.size() / 4, n = total / components;
  if (planes.size() != 4 * n * components) throw std::runtime_error("a block of odd size");
  std::vector<std::int32_t> values(total);
  for (std::size_t c = 0; c < components; ++c) {
    std::int64_t value = 0;
    for (std::size_t i = 0; i < n; ++i) {
      std::int64_t z = 0;
      for (int byte = 3; byte >= 0; --byte) {
        z = 256 * z +
            static_cast<unsigned char>(planes[static_cast<std::size_t>(byte) * total + c * n + i]);
      }
      value += z % 2 == 0 ? z / 2 : -(z + 1) / 2;
      values[i * components + c] = static_cast<std::int32_t>(static_cast<std::uint32_t>(value));
    }
  }
  return values;
}

PageFile::PageFile(const std::string& path) : text_(read_all(path)) {
  manifest_ = nlohmann::json::parse(element("manifest"));
}

bool PageFile::has(const std::string& id) const {
  return text_.find("id=\"" + id + "\">") != std::string::npos;
}

std::string PageFile::element(const std::string& id) const {
  const std::string mark = "id=\"" + id + "\">";
  const std::size_t at = text_.find(mark);
  if (at == std::string::npos) throw std::runtime_error("the page has no " + id);
  const std::size_t from = at + mark.size();
  return text_.substr(from, text_.find("</script>", from) - from);
}

std::string PageFile::block(const std::string& id) const { return bytes_of_base64(element(id)); }

}  // namespace dsc::test
