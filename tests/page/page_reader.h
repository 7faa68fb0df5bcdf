/// \file
/// Reads pages back, from the description in packing.h and sharing nothing with the writer.
#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace dsc::test {

std::string bytes_of_base64(const std::string& text);
/// What a zlib stream holds. \throws std::runtime_error where it is none.
std::string inflated(const std::string& bytes);
/// Integers of a block, interleaved.
std::vector<std::int32_t> unpacked(const std::string& block, std::size_t components);

class PageFile {
 public:
  /// \throws std::runtime_error where it is no page.
  explicit PageFile(const std::string& path);

  bool has(const std::string& id) const;
  /// The deflated bytes of a block.
  std::string block(const std::string& id) const;
  const nlohmann::json& manifest() const { return manifest_; }
  const std::string& text() const { return text_; }

 private:
  std::string element(const std::string& id) const;

  std::string text_;
  nlohmann::json manifest_;
};

}  // namespace dsc::test
