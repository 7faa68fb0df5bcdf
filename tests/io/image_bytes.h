/// \file
/// Medical images written byte by byte from the formats' descriptions, without ITK.
#pragma once

#include "libdsc/base/types.h"
#include "tests/io/volume_bytes.h"

#include <zlib.h>
#include <Eigen/Geometry>

#include <cstdio>
#include <cstring>
#include <sstream>

namespace dsc {

/// 16-bit values, x fastest, with their place in the world (millimetres, LPS).
struct TestImage {
  Index3 size{0, 0, 0};
  Vec3 spacing{1, 1, 1};
  Mat3 direction = Mat3::Identity();  ///< columns: the axes
  Vec3 origin{0, 0, 0};
  std::vector<std::int16_t> values;

  std::string value_bytes() const {
    std::string bytes;
    for (const std::int16_t v : values) bytes += little_endian(static_cast<std::uint16_t>(v), 2);
    return bytes;
  }
};

/// A turned frame; mirrored too where `mirror` is -1.
inline Mat3 test_direction(double mirror) {
  return Eigen::AngleAxisd(0.5, Vec3(1, -2, 2).normalized()).toRotationMatrix() *
         Eigen::DiagonalMatrix<double, 3>(1, mirror, 1);
}

/// Random values, many of them 0, in an odd box.
inline TestImage random_image(double mirror) {
  TestImage image{{7, 6, 5}, {0.5, 1.25, 2}, test_direction(mirror), {-10.5, 20.25, 30}, {}};
  unsigned state = 1;
  for (int i = 0; i < 7 * 6 * 5; ++i) {
    state = state * 1664525u + 1013904223u;
    image.values.push_back(static_cast<std::int16_t>((state >> 16) % 3 == 0 ? 0 : state >> 17));
  }
  return image;
}

inline std::string joined(std::initializer_list<double> numbers, const char* between) {
  std::ostringstream text;
  text.precision(17);
  const char* separator = "";
  for (const double n : numbers) {
    text << separator << n;
    separator = between;
  }
  return text.str();
}
inline std::string joined(const Vec3& v, const char* between) {
  return joined({v[0], v[1], v[2]}, between);
}
inline std::string sizes_of(const TestImage& image) {
  return std::to_string(image.size[0]) + " " + std::to_string(image.size[1]) + " " +
         std::to_string(image.size[2]);
}

inline std::string mha_bytes(const TestImage& image) {
  const Mat3& d = image.direction;
  return "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
         "CompressedData = False\nTransformMatrix = " +
         joined(d.col(0), " ") + " " + joined(d.col(1), " ") + " " + joined(d.col(2), " ") +
         "\nOffset = " + joined(image.origin, " ") +
         "\nElementSpacing = " + joined(image.spacing, " ") + "\nDimSize = " + sizes_of(image) +
         "\nElementType = MET_SHORT\nElementDataFile = LOCAL\n" + image.value_bytes();
}

inline std::string nrrd_bytes(const TestImage& image) {
  std::string axes;
  for (int a = 0; a < 3; ++a) {
    axes += " (" + joined(image.direction.col(a) * image.spacing[a], ",") + ")";
  }
  return "NRRD0004\ntype: short\ndimension: 3\nspace: left-posterior-superior\nsizes: " +
         sizes_of(image) + "\nspace directions:" + axes +
         "\nkinds: domain domain domain\nendian: little\nencoding: raw\nspace origin: (" +
         joined(image.origin, ",") + ")\n\n" + image.value_bytes();
}

/// NIfTI-1 with an sform; its world is RAS.
inline std::string nii_bytes(const TestImage& image) {
  std::string header(352, '\0');
  const auto put = [&](std::size_t at, auto value) {
    std::memcpy(header.data() + at, &value, sizeof value);
  };
  put(0, std::int32_t{348});
  put(40, std::int16_t{3});
  for (std::size_t a = 0; a < 3; ++a) put(42 + 2 * a, static_cast<std::int16_t>(image.size[a]));
  for (std::size_t a = 3; a < 7; ++a) put(42 + 2 * a, std::int16_t{1});
  put(70, std::int16_t{4});   // 16 bits, signed
  put(72, std::int16_t{16});  // bits a voxel
  put(76, 1.F);
  for (int a = 0; a < 3; ++a) {
    put(80 + 4 * static_cast<std::size_t>(a), static_cast<float>(image.spacing[a]));
  }
  put(108, 352.F);            // where the values begin
  put(123, std::int8_t{2});   // millimetres
  put(254, std::int16_t{1});  // an sform
  for (int row = 0; row < 3; ++row) {
    const double sign = row < 2 ? -1 : 1;  // LPS to RAS
    const auto at = 280 + 16 * static_cast<std::size_t>(row);
    for (int a = 0; a < 3; ++a) {
      put(at + 4 * static_cast<std::size_t>(a),
          static_cast<float>(sign * image.direction(row, a) * image.spacing[a]));
    }
    put(at + 12, static_cast<float>(sign * image.origin[row]));
  }
  std::memcpy(header.data() + 344, "n+1", 4);
  return header + image.value_bytes();
}

inline std::string gzipped(const std::string& bytes) {
  z_stream stream{};
  if (deflateInit2(&stream, 6, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY) != Z_OK) {
    throw Error("deflateInit2");
  }
  std::string out(deflateBound(&stream, bytes.size()) + 64, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  if (deflate(&stream, Z_FINISH) != Z_STREAM_END) throw Error("deflate");
  out.resize(stream.total_out);
  (void)deflateEnd(&stream);
  return out;
}

/// A TIFF of slices [first, last), each a page.
inline std::string tiff_bytes(const TestImage& image, Index first, Index last) {
  const auto width = static_cast<std::uint64_t>(image.size[0]);
  const auto height = static_cast<std::uint64_t>(image.size[1]);
  const std::uint64_t page = 2 * width * height;
  constexpr std::uint64_t kEntries = 10, kDirectory = 2 + 12 * kEntries + 4;
  std::string file = "II" + little_endian(42, 2) + little_endian(8, 4);
  for (Index z = first; z < last; ++z) {
    const std::uint64_t here = file.size();
    const std::uint64_t next = z + 1 < last ? here + kDirectory + page : 0;
    file += little_endian(kEntries, 2);
    const auto entry = [&](std::uint64_t tag, std::uint64_t value) {
      file += little_endian(tag, 2) + little_endian(4, 2) + little_endian(1, 4) +
              little_endian(value, 4);
    };
    entry(256, width);
    entry(257, height);
    entry(258, 16);  // bits
    entry(259, 1);   // not compressed
    entry(262, 1);   // black is 0
    entry(273, here + kDirectory);
    entry(277, 1);  // value a pixel
    entry(278, height);
    entry(279, page);
    entry(339, 2);  // signed
    file += little_endian(next, 4);
    file += image.value_bytes().substr(static_cast<std::size_t>(z) * page, page);
  }
  return file;
}

/// Slice z of a DICOM series, explicit little-endian.
inline std::string dicom_bytes(const TestImage& image, Index z, const std::string& series) {
  const auto element = [](unsigned group, unsigned number, const std::string& type,
                          std::string value) {
    if (value.size() % 2 == 1) value += type == "UI" ? '\0' : ' ';
    const bool wide = type == "OW" || type == "OB";
    return little_endian(group, 2) + little_endian(number, 2) + type +
           (wide ? std::string(2, '\0') + little_endian(value.size(), 4)
                 : little_endian(value.size(), 2)) +
           value;
  };
  const auto us = [&](unsigned number, unsigned value) {
    return element(0x28, number, "US", little_endian(value, 2));
  };
  const std::string ct = "1.2.840.10008.5.1.4.1.1.2";
  const std::string instance = series + "." + std::to_string(z + 1);
  const std::string meta = element(2, 1, "OB", std::string("\0\1", 2)) + element(2, 2, "UI", ct) +
                           element(2, 3, "UI", instance) +
                           element(2, 0x10, "UI", "1.2.840.10008.1.2.1");
  const Vec3 at = image.origin + image.direction.col(2) * image.spacing[2] * static_cast<double>(z);
  const auto page = static_cast<std::size_t>(2 * image.size[0] * image.size[1]);
  // Decimal strings have 16 characters at most.
  const auto decimals = [](std::initializer_list<double> numbers) {
    std::string text;
    for (const double n : numbers) {
      char buffer[32];
      std::snprintf(buffer, sizeof buffer, "%.10f", n);
      text += (text.empty() ? "" : "\\") + std::string(buffer);
    }
    return text;
  };
  const Vec3 x = image.direction.col(0), y = image.direction.col(1);
  return std::string(128, '\0') + "DICM" + element(2, 0, "UL", little_endian(meta.size(), 4)) +
         meta + element(8, 0x16, "UI", ct) + element(8, 0x18, "UI", instance) +
         element(8, 0x60, "CS", "CT") + element(0x20, 0xd, "UI", series + ".1") +
         element(0x20, 0xe, "UI", series) + element(0x20, 0x13, "IS", std::to_string(z + 1)) +
         element(0x20, 0x32, "DS", decimals({at[0], at[1], at[2]})) +
         element(0x20, 0x37, "DS", decimals({x[0], x[1], x[2], y[0], y[1], y[2]})) + us(2, 1) +
         element(0x28, 4, "CS", "MONOCHROME2") + us(0x10, static_cast<unsigned>(image.size[1])) +
         us(0x11, static_cast<unsigned>(image.size[0])) +
         element(0x28, 0x30, "DS", decimals({image.spacing[1], image.spacing[0]})) + us(0x100, 16) +
         us(0x101, 16) + us(0x102, 15) + us(0x103, 1) +
         element(0x7fe0, 0x10, "OW",
                 image.value_bytes().substr(static_cast<std::size_t>(z) * page, page));
}

}  // namespace dsc
