#include "libdsc/io/read_binary.h"

#include "libdsc/base/error.h"
#include "tests/io/temporary_folder.h"
#include "tests/io/volume_bytes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace dsc {
namespace {

/// A file with the values 0 to 255 along x.
class AllBytes : public testing::Test {
 protected:
  AllBytes() : path_(folder_ / "v.vol") {
    std::string bytes;
    for (int v = 0; v < 256; ++v) bytes += static_cast<char>(v);
    write_all(path_, vol_text(256, 1, 1, 2) + bytes);
  }

  /// Expects that exactly the values with inside(v) are selected.
  template <class Inside>
  void expect(const VoxelSelection& selection, const Inside& inside) const {
    const BinaryVolume volume = read_binary(path_, selection);
    for (int v = 0; v < 256; ++v) EXPECT_EQ(volume(v, 0, 0), inside(v)) << v;
  }

  TemporaryFolder folder_;
  std::string path_;
};

TEST_F(AllBytes, EveryNonzeroValueIsInsideByDefault) {
  expect({}, [](int v) { return v != 0; });
}

TEST_F(AllBytes, ThresholdsAreClosedAndExact) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  expect({{{10., 20.}}, {}}, [](int v) { return v >= 10 && v <= 20; });
  expect({{{9.5, 20.5}}, {}}, [](int v) { return v >= 10 && v <= 20; });
  expect({{{0., 0.}}, {}}, [](int v) { return v == 0; });
  expect({{{-1e300, 3.}}, {}}, [](int v) { return v <= 3; });
  expect({{{200., kInfinity}}, {}}, [](int v) { return v >= 200; });
  expect({{{-kInfinity, kInfinity}}, {}}, [](int) { return true; });
  expect({{{255., 255.}}, {}}, [](int v) { return v == 255; });
  expect({{{256., 300.}}, {}}, [](int) { return false; });
  expect({{{-5., -1.}}, {}}, [](int) { return false; });
  expect({{{7.2, 7.8}}, {}}, [](int) { return false; });
}

TEST_F(AllBytes, LabelsSelectTheirValuesOnly) {
  expect({{}, {7}}, [](int v) { return v == 7; });
  expect({{}, {0}}, [](int v) { return v == 0; });
  expect({{}, {250, 3, 3, 8}}, [](int v) { return v == 250 || v == 3 || v == 8; });
  expect({{}, {-1, 263, 1000000}}, [](int) { return false; });  // none wraps into a byte
}

TEST_F(AllBytes, ContradictionsAreRefused) {
  EXPECT_THROW((void)read_binary(path_, {{{1., 2.}}, {1}}), UsageError);
  EXPECT_THROW((void)read_binary(path_, {{{2., 1.}}, {}}), UsageError);
  EXPECT_THROW((void)read_binary(path_, {{{std::nan(""), 1.}}, {}}), UsageError);
}

TEST_F(AllBytes, CancellationEndsTheReading) {
  Monitor monitor;
  monitor.cancel();
  EXPECT_THROW((void)read_binary(path_, {}, Context{1, &monitor}), Cancelled);
}

}  // namespace
}  // namespace dsc
