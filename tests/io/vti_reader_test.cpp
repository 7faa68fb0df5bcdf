// .vti files, written here by the words of the format, in each of its
// encodings.
#include "libdsc/base/error.h"
#include "libdsc/io/volume_source.h"
#include "libdsc/io/volume_writer.h"
#include "tests/io/temporary_folder.h"
#include "tests/io/volume_bytes.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <fstream>

namespace dsc {
namespace {

std::string base64(const std::string &bytes) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned value = 0;
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
    for (std::size_t k = 0; k < 3; ++k) {
      value = value << 8 | (k < n ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += k <= n ? digits[value >> (18 - 6 * k) & 63] : '=';
    }
  }
  return text;
}

std::string deflated(const std::string &bytes) {
  uLongf size = compressBound(bytes.size());
  std::string packed(size, '\0');
  EXPECT_EQ(compress(reinterpret_cast<Bytef *>(packed.data()), &size,
                     reinterpret_cast<const Bytef *>(bytes.data()), bytes.size()),
            Z_OK);
  packed.resize(size);
  return packed;
}

/// How a file says it.
struct Style {
  bool wide = false;  ///< words of 8 bytes
  bool big_endian = false;
  Index block = 0;  ///< bytes of a compressed block; 0: none is
  enum Form { ascii, inline_base64, appended_base64, appended_raw } form = appended_raw;
};

std::string word(std::uint64_t value, const Style &style) {
  std::string bytes = little_endian(value, style.wide ? 8 : 4);
  if (style.big_endian) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

/// Sizes, then values; each its own piece of base64 where compressed.
std::string wrapped(std::string values, const Style &style, int value_bytes) {
  if (style.big_endian) {
    for (std::size_t i = 0; i < values.size(); i += static_cast<std::size_t>(value_bytes)) {
      std::reverse(values.begin() + static_cast<std::ptrdiff_t>(i),
                   values.begin() + static_cast<std::ptrdiff_t>(i) + value_bytes);
    }
  }
  const bool raw = style.form == Style::appended_raw;
  if (style.block == 0) {
    const std::string all = word(values.size(), style) + values;
    return raw ? all : base64(all);
  }
  const auto block = static_cast<std::size_t>(style.block);
  std::vector<std::string> blocks;
  for (std::size_t i = 0; i < values.size(); i += block) {
    blocks.push_back(deflated(values.substr(i, block)));
  }
  std::string sizes =
      word(blocks.size(), style) + word(block, style) + word(values.size() % block, style);
  std::string data;
  for (const std::string &packed : blocks) {
    sizes += word(packed.size(), style);
    data += packed;
  }
  return raw ? sizes + data : base64(sizes) + base64(data);
}

const char *const kPlace = "WholeExtent=\"2 4 0 1 5 6\" Origin=\"10 20 30\" Spacing=\"0.5 1 2\"";

/// 3 x 2 x 2 points with the values 100, 101, … as Int16.
std::string file_of(const Style &style, const std::string &place = kPlace) {
  std::string values, numbers;
  for (int i = 0; i < 12; ++i) {
    values += little_endian(static_cast<std::uint64_t>(100 + i), 2);
    numbers += std::to_string(100 + i) + (i % 5 == 4 ? "\n" : " ");
  }
  const bool appended = style.form >= Style::appended_base64;
  const std::string payload = style.form == Style::ascii ? numbers : wrapped(values, style, 2);
  const std::string format = appended                     ? "appended\" offset=\"0"
                             : style.form == Style::ascii ? "ascii"
                                                          : "binary";
  const std::string extent =
      place.substr(place.find('"'), place.find('"', place.find('"') + 1) - place.find('"') + 1);
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" "
      "version=\"1.0\" byte_order=\"";
  text += style.big_endian ? "BigEndian\"" : "LittleEndian\"";
  if (style.wide) text += " header_type=\"UInt64\"";
  if (style.block > 0) text += " compressor=\"vtkZLibDataCompressor\"";
  text += ">\n <ImageData " + place + ">\n  <Piece Extent=" + extent +
          ">\n   <PointData Scalars=\"ct\">\n";
  text +=
      "<DataArray type=\"Float32\" Name=\"vectors\" "
      "NumberOfComponents=\"3\" format=\"ascii\">0 0 0</DataArray>";
  text += "<DataArray type=\"Int16\" Name=\"ct\" format=\"" + format + "\">" +
          (appended ? "" : "\n    " + payload + "\n") +
          "</DataArray>\n   </PointData>\n   <CellData/>\n  </Piece>\n "
          "</ImageData>\n";
  if (appended) {
    text += std::string(" <AppendedData encoding=\"") +
            (style.form == Style::appended_raw ? "raw" : "base64") + "\">\n   _" + payload +
            "\n </AppendedData>\n";
  }
  return text + "</VTKFile>\n";
}

void write_bytes(const std::string &path, const std::string &bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

std::vector<Style> styles() {
  std::vector<Style> all;
  for (const bool wide : {false, true}) {
    for (const bool big : {false, true}) {
      for (const Index block : {0, 7, 8, 24, 1000}) {
        for (const auto form :
             {Style::ascii, Style::inline_base64, Style::appended_base64, Style::appended_raw}) {
          all.push_back({wide, big, block, form});
        }
      }
    }
  }
  return all;
}

TEST(VtiReader, EveryEncodingHoldsTheSameVoxels) {
  const TemporaryFolder folder;
  const std::string path = folder / "v.vti";
  for (const Style &style : styles()) {
    SCOPED_TRACE(std::to_string(style.form) + " " + std::to_string(style.block));
    write_bytes(path, file_of(style));
    const auto source = open_volume(path);
    EXPECT_EQ(source->grid().size, (Index3{3, 2, 2}));
    EXPECT_EQ(source->grid().spacing, Vec3(0.5, 1, 2));
    EXPECT_EQ(source->world()(Vec3::Zero()), Vec3(10 + 2 * 0.5, 20, 30 + 5 * 2));
    const std::vector<double> values = values_of(*source);
    ASSERT_EQ(values.size(), 12U);
    for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(values[i], 100. + static_cast<double>(i));
  }
}

TEST(VtiReader, AFileThatIsCutIsNeverRead) {
  const TemporaryFolder folder;
  const std::string path = folder / "v.vti";
  for (const Style &style : styles()) {
    if (style.wide || style.big_endian || (style.block != 0 && style.block != 8)) continue;
    const std::string whole = file_of(style);
    // Of appended values nothing is needed after their last byte.
    const std::size_t needed =
        style.form >= Style::appended_base64 ? whole.rfind("\n </Appended") : whole.size() - 1;
    for (std::size_t size = 0; size < needed; ++size) {
      write_bytes(path, whole.substr(0, size));
      EXPECT_THROW(values_of(*open_volume(path)), InputError) << size << " of " << needed;
    }
  }
}

TEST(VtiReader, DirectionsTurnTheWorldAndCellsLieBetweenPoints) {
  const TemporaryFolder folder;
  const std::string path = folder / "v.vti";
  std::string text = file_of({}, std::string(kPlace) + " Direction=\"0 -1 0 1 0 0 0 0 1\"");
  write_bytes(path, text);
  EXPECT_EQ(open_volume(path)->world()(Vec3(1, 0, 0)), Vec3(10, 20 + 2 * 0.5 + 1, 40));

  // 3 x 2 x 2 cells of 4 x 3 x 3 points.
  text = file_of({}, "WholeExtent=\"0 3 0 2 0 2\" Origin=\"0 0 0\" Spacing=\"1 1 1\"");
  const auto swap = [&](const std::string &from, const std::string &to) {
    text.replace(text.find(from), from.size(), to);
  };
  swap("<PointData Scalars", "<CellData Scalars");
  swap("</PointData>\n   <CellData/>", "</CellData>");
  write_bytes(path, text);
  const auto source = open_volume(path);
  EXPECT_EQ(source->grid().size, (Index3{3, 2, 2}));
  EXPECT_EQ(source->world()(Vec3::Zero()), Vec3(0.5, 0.5, 0.5));
  EXPECT_EQ(values_of(*source).back(), 111);
}

TEST(VtiReader, WhatItCannotReadIsRefusedByName) {
  const TemporaryFolder folder;
  const std::string path = folder / "v.vti";
  const std::string good = file_of({.form = Style::ascii});
  const auto expect = [&](const std::string &from, const std::string &to, const std::string &word) {
    std::string text = good;
    ASSERT_NE(text.find(from), std::string::npos) << from;
    text.replace(text.find(from), from.size(), to);
    write_bytes(path, text);
    try {
      values_of(*open_volume(path));
      ADD_FAILURE() << to << " was read";
    } catch (const InputError &error) {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(path), std::string::npos) << error.what();
    }
  };
  expect("ImageData", "PolyData", "PolyData");
  expect("Extent=\"2 4 0 1 5 6\">", "Extent=\"2 3 0 1 5 6\">", "pieces");
  expect("WholeExtent=\"2 4 0", "WholeExtent=\"2 4 x", "WholeExtent");
  expect("Spacing=\"0.5", "Spacing=\"-0.5", "spacing");
  expect("Int16", "Int128", "Int128");
  expect("100 ", "100.5 ", "no value");
  expect("100 ", "100000 ", "no value");
  expect(" 111", "", "end before");
  expect(" 111", " 111 112", "more numbers");
  expect("<?xml version=\"1.0\"?>\n", "<!DOCTYPE a>\n", "document type");

  write_bytes(path, file_of({}, "WholeExtent=\"4 2 0 1 5 6\" Origin=\"0 0 0\" Spacing=\"1 1 1\""));
  EXPECT_THROW(open_volume(path), InputError);
  std::string two = good;
  two.replace(two.find("NumberOfComponents=\"3\""), 22, "");
  two.replace(two.find("Scalars=\"ct\""), 12, "");
  write_bytes(path, two);
  EXPECT_THROW(open_volume(path), InputError);  // which of the two arrays?
}

TEST(VtiWriter, WritesWhatTheReaderReadsToTheLastBit) {
  const TemporaryFolder folder;
  const std::string path = folder / "v.vti";
  Grid grid;
  grid.size = {5, 3, 4};
  grid.spacing = Vec3(0.1, 0.25, 3);
  grid.origin = Vec3(-1, 2, 1. / 3);
  std::vector<double> values(60);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = 1. / (1. + static_cast<double>(i));
  for (const bool compress : {true, false}) {
    VolumeWriteOptions options;
    options.compress = compress;
    options.world.rotation << 0, -1, 0, 1, 0, 0, 0, 0, 1;
    options.world.translation = Vec3(7, 8, 9);
    write_volume(path, grid, std::span<const double>(values), options);
    const auto source = open_volume(path);
    EXPECT_EQ(source->grid().size, grid.size);
    EXPECT_EQ(source->grid().spacing, grid.spacing);
    EXPECT_EQ(source->world()(Vec3::Zero()), options.world(grid.origin));
    EXPECT_EQ(source->world().rotation, options.world.rotation);
    EXPECT_EQ(values_of(*source), values);
  }
}

}  // namespace
}  // namespace dsc
