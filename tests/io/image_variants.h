/// \file
/// More ways to write the images of image_bytes.h.
#pragma once

#include "tests/io/image_bytes.h"

namespace dsc {

/// Three by four by two voxels, none of them 0.
inline TestImage small_image() {
  TestImage image;
  image.size = {3, 4, 2};
  for (int i = 0; i < 3 * 4 * 2; ++i)
    image.values.push_back(static_cast<std::int16_t>(1000 + 7 * i));
  return image;
}

/// The same with deflated values.
inline std::string compressed_mha(const TestImage& image) {
  std::string text = mha_bytes(image);
  text.replace(text.find("CompressedData = False"), 22, "CompressedData = True");
  const std::string values = deflated(image.value_bytes());
  text.insert(text.find("ElementDataFile"),
              "CompressedDataSize = " + std::to_string(values.size()) + "\n");
  return text.substr(0, text.find("LOCAL\n") + 6) + values;
}

inline std::string compressed_nrrd(const TestImage& image) {
  std::string text = nrrd_bytes(image);
  text.replace(text.find("encoding: raw"), 13, "encoding: gzip");
  return text.substr(0, text.find("\n\n") + 2) + gzipped(image.value_bytes());
}

/// One page, its directory after the values, as most programs write it.
inline std::string tiff_with_directory_last(const TestImage& image, bool compress) {
  const auto width = static_cast<std::uint64_t>(image.size[0]);
  const auto height = static_cast<std::uint64_t>(image.size[1]);
  std::string values = image.value_bytes().substr(0, 2 * width * height);
  if (compress) values = deflated(values);
  if (values.size() % 2 == 1) values += '\0';
  std::string file = "II" + little_endian(42, 2) + little_endian(8 + values.size(), 4) + values;
  constexpr std::uint64_t kEntries = 10;
  file += little_endian(kEntries, 2);
  const auto entry = [&](std::uint64_t tag, std::uint64_t value) {
    file +=
        little_endian(tag, 2) + little_endian(4, 2) + little_endian(1, 4) + little_endian(value, 4);
  };
  entry(256, width);
  entry(257, height);
  entry(258, 16);
  entry(259, compress ? 8 : 1);
  entry(262, 1);
  entry(273, 8);
  entry(277, 1);
  entry(278, height);
  entry(279, values.size());
  entry(339, 2);
  return file + little_endian(0, 4);
}

/// How the elements of a DICOM file are written: its transfer syntax.
constexpr const char* kImplicit = "1.2.840.10008.1.2";
constexpr const char* kExplicit = "1.2.840.10008.1.2.1";
constexpr const char* kDeflated = "1.2.840.10008.1.2.1.99";
constexpr const char* kBigEndian = "1.2.840.10008.1.2.2";

inline std::string deflated_without_head(const std::string& bytes) {
  std::string whole = deflated(bytes);  // two bytes before, a checksum of four after
  whole = whole.substr(2, whole.size() - 6);
  return whole + std::string(whole.size() % 2, '\0');
}

/// Slice 0 of the image with `values` as its pixel data, after a sequence of undefined length.
inline std::string dicom_variant(const TestImage& image, const std::string& syntax,
                                 std::string values) {
  const bool big = syntax == kBigEndian, typed = syntax != kImplicit;
  const auto number = [&](std::uint64_t value, int bytes) {
    std::string text = little_endian(value, bytes);
    if (big) std::reverse(text.begin(), text.end());
    return text;
  };
  const auto head = [&](unsigned group, unsigned id, const std::string& type, std::uint64_t length,
                        bool with_type) {
    const bool wide = type == "OW" || type == "OB" || type == "SQ";
    const std::string tag = number(group, 2) + number(id, 2);
    if (!with_type) return tag + number(length, 4);
    return tag + type + (wide ? std::string(2, '\0') + number(length, 4) : number(length, 2));
  };
  const auto element = [&](unsigned group, unsigned id, const std::string& type,
                           std::string value) {
    if (value.size() % 2 == 1) value += type == "UI" ? '\0' : ' ';
    return head(group, id, type, value.size(), typed) + value;
  };
  const auto us = [&](unsigned id, std::uint64_t value) {
    return element(0x28, id, "US", number(value, 2));
  };
  if (big) {
    for (std::size_t i = 0; i + 1 < values.size(); i += 2) std::swap(values[i], values[i + 1]);
  }
  const std::string ct = "1.2.840.10008.5.1.4.1.1.2";
  std::string data = element(8, 0x16, "UI", ct) + element(8, 0x18, "UI", "1.2.3.4.1") +
                     element(8, 0x60, "CS", "CT");
  constexpr std::uint64_t kUndefined = 0xffffffff;
  data += head(8, 0x1140, "SQ", kUndefined, typed) + head(0xfffe, 0xe000, "", kUndefined, false) +
          element(8, 0x1150, "UI", ct) + head(0xfffe, 0xe00d, "", 0, false) +
          head(0xfffe, 0xe0dd, "", 0, false);
  data += element(0x20, 0xd, "UI", "1.2.3") + element(0x20, 0xe, "UI", "1.2.3.4") +
          element(0x20, 0x13, "IS", "1") + element(0x20, 0x32, "DS", "0\\0\\0") +
          element(0x20, 0x37, "DS", "1\\0\\0\\0\\1\\0") + us(2, 1) +
          element(0x28, 4, "CS", "MONOCHROME2") +
          us(0x10, static_cast<std::uint64_t>(image.size[1])) +
          us(0x11, static_cast<std::uint64_t>(image.size[0])) + element(0x28, 0x30, "DS", "1\\1") +
          us(0x100, 16) + us(0x101, 16) + us(0x102, 15) + us(0x103, 1) +
          element(0x7fe0, 0x10, "OW", values);
  const auto meta_element = [](unsigned id, const std::string& type, std::string value) {
    if (value.size() % 2 == 1) value += '\0';
    return little_endian(2, 2) + little_endian(id, 2) + type +
           (type == "OB" ? std::string(2, '\0') + little_endian(value.size(), 4)
                         : little_endian(value.size(), 2)) +
           value;
  };
  const std::string meta = meta_element(1, "OB", std::string("\0\1", 2)) +
                           meta_element(2, "UI", ct) + meta_element(3, "UI", "1.2.3.4.1") +
                           meta_element(0x10, "UI", syntax);
  return std::string(128, '\0') + "DICM" + meta_element(0, "UL", little_endian(meta.size(), 4)) +
         meta + (syntax == kDeflated ? deflated_without_head(data) : data);
}

inline std::string dicom_variant(const TestImage& image, const std::string& syntax) {
  const auto page = static_cast<std::size_t>(2 * image.size[0] * image.size[1]);
  return dicom_variant(image, syntax, image.value_bytes().substr(0, page));
}

}  // namespace dsc
