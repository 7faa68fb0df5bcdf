// .vti files, written here by the words of the format, in each of its encodings.
#include "libdsc/base/error.h"
#include "libdsc/io/volume_source.h"
#include "libdsc/io/volume_writer.h"
#include "tests/io/temporary_folder.h"
#include "tests/io/volume_bytes.h"
#include "tests/support/stage_memory.h"

#include <gtest/gtest.h>
#include <malloc.h>
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

/// An image of bytes, and what stands for them: sizes in words of 8 bytes, then zlib streams.
std::string image_of_blocks(const Index3 &size, const std::string &sizes_and_blocks) {
  std::string extent;
  for (const Index n : size) extent += "0 " + std::to_string(n - 1) + " ";
  return "<VTKFile type=\"ImageData\" byte_order=\"LittleEndian\" header_type=\"UInt64\" "
         "compressor=\"vtkZLibDataCompressor\"><ImageData WholeExtent=\"" +
         extent + "\"><Piece Extent=\"" + extent +
         "\"><PointData><DataArray type=\"UInt8\" Name=\"v\" format=\"appended\" offset=\"0\"/>"
         "</PointData></Piece></ImageData><AppendedData encoding=\"raw\">_" +
         sizes_and_blocks;
}

/// The number of blocks, the size of each and of the last, and the compressed sizes.
std::string words_of(const std::vector<std::uint64_t> &values) {
  std::string words;
  for (const std::uint64_t value : values) words += little_endian(value, 8);
  return words;
}

/// Notes the most that is asked for at once, and refuses more than `allowed`.
class AskedMemory final : public MemoryLimit {
 public:
  explicit AskedMemory(Index allowed) : allowed_(allowed) {}
  void need(std::string_view stage, Index bytes) const override {
    most = std::max(most, bytes);
    if (bytes > allowed_) throw LimitError("refused to '" + std::string(stage) + "'");
  }
  Index left() const override { return allowed_; }
  mutable Index most = 0;

 private:
  Index allowed_;
};

constexpr Index kMiB = Index{1} << 20;

/// What `run` takes at its peak, beside what was held.
template <class Run>
Index taken_by(const Run &run) {
  (void)::malloc_trim(0);
  testing::reset_peak();
  const Index held = resident_bytes();
  run();
  return testing::peak_bytes() - held;
}

TEST(VtiReader, ABlockOfAnySizeTakesNoMemory) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers take memory of their own";
#endif
  const TemporaryFolder folder;
  const std::string path = folder / "v.vti";
  const Index3 size{1024, 1024, 64};
  {
    const std::string packed = deflated(std::string(64 * kMiB, '\7'));
    write_bytes(path, image_of_blocks(size, words_of({1, 64 * kMiB, 0, packed.size()}) + packed));
  }
  const auto source = open_volume(path);
  const AskedMemory memory(8 * kMiB);
  Index sevens = 0;
  const Index taken = taken_by([&] {
    source->read(
        [&](const Slab &slab) {
          const auto values = std::get<std::span<const std::uint8_t>>(slab.values);
          sevens += std::count(values.begin(), values.end(), 7);
        },
        {1, nullptr, &memory});
  });
  EXPECT_EQ(sevens, 64 * kMiB);
  EXPECT_LT(taken, 12 * kMiB) << "a slab is 4 MiB";
}

TEST(VtiReader, TheSizesOfManyBlocksAreAskedFor) {
  const TemporaryFolder folder;
  const std::string path = folder / "v.vti";
  const Index3 size{100, 100, 20};
  const std::uint64_t n = 200000;  // blocks of a byte each
  const std::string packed = deflated("\7");
  std::vector<std::uint64_t> sizes{n, 1, 0};
  sizes.resize(3 + n, packed.size());
  std::string data = words_of(sizes);
  for (std::uint64_t i = 0; i < n; ++i) data += packed;
  write_bytes(path, image_of_blocks(size, data));
  const AskedMemory little(kMiB), enough(4 * kMiB);
  EXPECT_THROW(open_volume(path)->read([](const Slab &) {}, {1, nullptr, &little}), LimitError);
  EXPECT_NO_THROW(open_volume(path)->read([](const Slab &) {}, {1, nullptr, &enough}));
  EXPECT_GE(enough.most, static_cast<Index>(8 * n));
}

/// Expects a refusal with `part` in its message that asks for and takes less than 12 MiB.
void expect_refused_in_little(const std::string &path, const std::string &part) {
  const AskedMemory memory(Index{1} << 40);
  const Index taken = taken_by([&] {
    expect_input_error(
        [&] {
          open_volume(path)->read([](const Slab &) {}, {1, nullptr, &memory});
        },
        {path, part});
  });
  EXPECT_LT(memory.most, 12 * kMiB);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  EXPECT_LT(taken, 12 * kMiB);
#else
  (void)taken;
#endif
}

TEST(VtiReader, BlocksThatAreNotThereTakeNoMemory) {
  const TemporaryFolder folder;
  const std::string path = folder / "v.vti";
  const std::string filler(100000, 'x');  // as if values might be in it
  write_bytes(path, image_of_blocks({1000, 1000, 50}, words_of({50000000, 1, 0}) + filler));
  expect_refused_in_little(path, "do not fit the file");
  write_bytes(path, image_of_blocks({1000, 1000, 50}, words_of({1, 50000000, 0, 1}) + filler));
  expect_refused_in_little(path, "block 1 does not fit the file");
  write_bytes(path, image_of_blocks({1000, 1000, 50}, words_of({1, 50000000, 0, 100001}) + filler));
  expect_refused_in_little(path, "block 1 does not fit the file");
  // 2^24 blocks of 2^40 bytes and one of 1000: their sum is 1000 in 64 bits.
  const std::uint64_t two = 1;
  write_bytes(path, image_of_blocks({10, 10, 10}, words_of({(two << 24) + 1, two << 40, 1000})));
  std::filesystem::resize_file(path, (std::uintmax_t{1} << 30) + 4096);
  expect_refused_in_little(path, "do not make the 1000 bytes");
}

TEST(VtiReader, AFileTooShortForItsExtentIsNotOpened) {
  const TemporaryFolder folder;
  const std::string path = folder / "v.vti";
  const std::string place = "WholeExtent=\"0 1999 0 1999 0 1999\"";
  for (const Style &style : styles()) {
    write_bytes(path, file_of(style, place));
    expect_input_error([&] { (void)open_volume(path); }, {path, "more than the file can hold"});
  }
}

TEST(VtiReader, ABlockIsAsLongAsItsSizesSay) {
  const TemporaryFolder folder;
  const std::string path = folder / "v.vti";
  const auto write = [&](const std::string &packed, std::uint64_t said) {
    const std::string other = deflated("123456789012");
    write_bytes(path, image_of_blocks({12, 2, 1},
                                      words_of({2, 12, 0, said, other.size()}) + packed + other));
  };
  const std::string good = deflated("abcdefghijkl");
  write(good, good.size());
  EXPECT_EQ(values_of(*open_volume(path)).back(), '2');
  std::string wrong_sum = good;
  wrong_sum.back() = static_cast<char>(wrong_sum.back() ^ 1);
  const auto expect_damaged = [&](const std::string &packed, std::uint64_t said) {
    write(packed, said);
    expect_input_error([&] { (void)values_of(*open_volume(path)); }, {path, "block 1", "damaged"});
  };
  expect_damaged(wrong_sum, good.size());
  expect_damaged(good + "x", good.size() + 1);
  expect_damaged(good, good.size() - 1);
  for (const char *text : {"abcdefghijk", "abcdefghijklm"}) {
    expect_damaged(deflated(text), deflated(text).size());
  }
}

/// Cancels where the sizes of the blocks are asked for, after the slab.
class CancelInTheMidst final : public MemoryLimit {
 public:
  explicit CancelInTheMidst(Monitor &monitor) : monitor_(monitor) {}
  void need(std::string_view, Index) const override {
    if (++asked_ == 2) monitor_.cancel();
  }
  Index left() const override { return Index{1} << 40; }

 private:
  Monitor &monitor_;
  mutable int asked_ = 0;
};

TEST(VtiReader, ASliceIsCancelledBeforeItsEnd) {
  const TemporaryFolder folder;
  const std::string path = folder / "v.vti";
  const std::string packed = deflated(std::string(16 * kMiB, '\7'));
  write_bytes(
      path, image_of_blocks({4096, 4096, 1}, words_of({1, 16 * kMiB, 0, packed.size()}) + packed));
  Monitor monitor;
  const CancelInTheMidst memory(monitor);
  bool whole = false;
  EXPECT_THROW(open_volume(path)->read([&](const Slab &) { whole = true; }, {1, &monitor, &memory}),
               Cancelled);
  EXPECT_FALSE(whole);
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
