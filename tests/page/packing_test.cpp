// Integers come back from a page as they went in, by a reader of the tests' own and by the page's.
#include "libdsc/page/packing.h"

#include "libdsc/io/base64.h"
#include "tests/io/temporary_folder.h"
#include "tests/page/page_reader.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <random>

namespace dsc {
namespace {

/// Of every size, extremes side by side, and long even runs.
std::vector<std::int32_t> integers(std::size_t n, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<std::int32_t> values;
  while (values.size() < n) {
    switch (random() % 4) {
      case 0:
        values.push_back(std::numeric_limits<std::int32_t>::min());
        break;
      case 1:
        values.push_back(std::numeric_limits<std::int32_t>::max());
        break;
      case 2:
        values.push_back(static_cast<std::int32_t>(random()));
        break;
      default:
        values.push_back(static_cast<std::int32_t>(random() % 5) - 2);
    }
  }
  return values;
}

TEST(PackedIntegers, ComeBackWhateverTheyAre) {
  for (const std::size_t components : {1U, 2U, 3U, 4U, 7U}) {
    for (const std::size_t n : {0U, 1U, 2U, 1000U}) {
      const auto values = integers(n * components, static_cast<unsigned>(n + components));
      EXPECT_EQ(test::unpacked(detail::packed(values, components), components), values);
    }
  }
}

TEST(PackedIntegers, OfALatticeTakeLittleRoom) {
  std::vector<std::int32_t> values;  // rows of a surface: neighbours differ by one
  for (std::int32_t i = 0; i < 100000; ++i) values.push_back(i % 317);
  EXPECT_LT(detail::packed(values, 1).size(), values.size() / 50);
}

TEST(Deflated, StreamsOfAnySizeComeBack) {
  std::mt19937 random(3);
  for (const std::size_t n : {0U, 1U, 65535U, 65536U, 1U << 20, 3000001U}) {
    std::string bytes(n, '\0');
    for (char& byte : bytes) byte = static_cast<char>(random());
    EXPECT_EQ(test::inflated(detail::deflated(bytes)), bytes);
  }
}

TEST(Deflated, IsCancelledAlongTheWay) {
  Monitor monitor;
  monitor.cancel();
  EXPECT_THROW((void)detail::deflated(std::string(5000000, 'a'), {1, &monitor}), Cancelled);
}

TEST(PackedIntegers, TheDecoderOfThePageReadsThem) {
#ifdef DSC_NODE
  const TemporaryFolder folder;
  write_all(folder / "decode.js",
            "const fs = require('fs'), vm = require('vm');\n"
            "vm.runInThisContext(fs.readFileSync(process.argv[2], 'utf8'));\n"
            "const text = fs.readFileSync(process.argv[3], 'utf8');\n"
            "inflated(bytesOfBase64(text)).then((planes) => {\n"
            "  const values = integersOfPlanes(planes, Number(process.argv[4]));\n"
            "  const floats = floatsOfIntegers(values);\n"
            "  const bytes = Buffer.from(floats.buffer, floats.byteOffset, floats.byteLength);\n"
            "  fs.writeFileSync(process.argv[5], bytes);\n"
            "});\n");
  for (const std::size_t components : {1U, 3U, 4U}) {
    for (const std::size_t n : {0U, 1U, 2U, 3U, 5000U}) {  // every length of the last group
      const auto values = integers(n * components, static_cast<unsigned>(7 * n + components));
      std::string text;
      detail::append_base64(text, detail::packed(values, components));
      write_all(folder / "block", text);
      const std::string command = std::string(DSC_NODE) + " " + (folder / "decode.js") +
                                  " " DSC_PAGE_SOURCE "/codec.js " + (folder / "block") + " " +
                                  std::to_string(components) + " " + (folder / "out");
      ASSERT_EQ(std::system(command.c_str()), 0) << command;
      const std::string bytes = read_all(folder / "out");
      std::vector<std::int32_t> read(bytes.size() / 4);
      if (!read.empty()) std::memcpy(read.data(), bytes.data(), bytes.size());
      EXPECT_EQ(read, values);
    }
  }
#else
  GTEST_SKIP() << "no node (Debian: nodejs)";
#endif
}

}  // namespace
}  // namespace dsc
