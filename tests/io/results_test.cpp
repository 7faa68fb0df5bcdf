// Results read back by small independent parsers, bit for bit.
#include "libdsc/io/results.h"

#include "tests/io/result_parsers.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>

namespace dsc {
namespace {

namespace fs = std::filesystem;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Any bits but NaN: denormals, infinities and negative zero included.
std::vector<double> random_doubles(std::size_t n, unsigned seed) {
  std::mt19937_64 random(seed);
  std::vector<double> values;
  while (values.size() < n) {
    const std::uint64_t bits = random();
    double value;
    std::memcpy(&value, &bits, sizeof value);
    if (value == value) values.push_back(value);
  }
  return values;
}

/// Bits, so that -0 and 0 differ.
std::vector<std::uint64_t> bits_of(std::span<const double> values) {
  std::vector<std::uint64_t> bits(values.size());
  if (!values.empty()) std::memcpy(bits.data(), values.data(), values.size_bytes());
  return bits;
}

/// A mesh whose values are arbitrary: quads, or a mix of triangles and a hexagon.
struct Sample {
  std::vector<double> positions, distance, heat, normals;
  std::vector<VertexId> corners;
  std::vector<Index> offsets;
  Result result;

  explicit Sample(bool quads, std::size_t vertices = 1000, std::size_t faces = 700) {
    positions = random_doubles(3 * vertices, 1);
    for (double& p : positions) {
      if (!std::isfinite(p)) p = 0.1;
    }
    std::mt19937 random(2);
    for (std::size_t f = 0; f < faces; ++f) {
      const std::size_t n = quads ? 4 : (f % 7 == 3 ? 6 : 3);
      if (!quads) offsets.push_back(static_cast<Index>(corners.size()));
      for (std::size_t c = 0; c < n; ++c) {
        corners.push_back(static_cast<VertexId>(random() % vertices));
      }
    }
    if (!quads) offsets.push_back(static_cast<Index>(corners.size()));
    distance = random_doubles(vertices, 3);
    distance[5] = kInfinity;
    distance[6] = -0.;
    heat = random_doubles(faces, 4);
    normals = random_doubles(3 * faces, 5);
    result.mesh.positions = {positions.data(), static_cast<Index>(vertices)};
    result.mesh.corners = corners;
    result.mesh.offsets = offsets;
    result.fields.push_back(scalar_field("distance", FieldOn::vertex, distance));
    result.fields.push_back({"normal", {"nx", "ny", "nz"}, FieldOn::face, normals});
    result.fields.push_back(scalar_field("heat", FieldOn::face, heat));
  }
};

class ResultFiles : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() /
              ("dsc_results_" + std::string(test->name()) + "_" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::size_t files() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  fs::path folder_;
};

TEST_F(ResultFiles, PlyHoldsEveryBit) {
  for (const bool quads : {true, false}) {
    const Sample sample(quads);
    EXPECT_TRUE(write_result(path("a.ply"), sample.result).empty());
    const test::PlyFile ply = test::read_ply(path("a.ply"));
    EXPECT_EQ(bits_of(ply.vertex_columns({"x", "y", "z"})), bits_of(sample.positions));
    EXPECT_EQ(bits_of(ply.vertex_columns({"distance"})), bits_of(sample.distance));
    EXPECT_EQ(bits_of(ply.face_columns({"nx", "ny", "nz"})), bits_of(sample.normals));
    EXPECT_EQ(bits_of(ply.face_columns({"heat"})), bits_of(sample.heat));
    ASSERT_EQ(ply.faces.size(), 700U);
    for (std::size_t f = 0; f < ply.faces.size(); ++f) {
      const auto corners = sample.result.mesh.face(static_cast<Index>(f));
      EXPECT_EQ(ply.faces[f], std::vector<std::int32_t>(corners.begin(), corners.end()));
    }
  }
}

TEST_F(ResultFiles, PlyTakesAFaceOfMoreThan255Corners) {
  Sample sample(true);
  sample.corners.assign(300, 7);
  sample.offsets = {0, 300};
  sample.result.mesh.corners = sample.corners;
  sample.result.mesh.offsets = sample.offsets;
  sample.result.fields.resize(1);
  write_result(path("a.ply"), sample.result);
  const test::PlyFile ply = test::read_ply(path("a.ply"));
  ASSERT_EQ(ply.faces.size(), 1U);
  EXPECT_EQ(ply.faces[0].size(), 300U);
}

TEST_F(ResultFiles, VtpIsWellFormedAndHoldsEveryBit) {
  for (const bool quads : {true, false}) {
    for (const std::size_t vertices :
         {1000U, 1001U, 1002U, 40001U}) {  // base64 pads by the size mod 3
      const Sample sample(quads, vertices, vertices - 300);
      EXPECT_TRUE(write_result(path("a.vtp"), sample.result).empty());
      const test::VtpFile vtp = test::read_vtp(path("a.vtp"));
      EXPECT_EQ(vtp.points, static_cast<Index>(vertices));
      EXPECT_EQ(vtp.polys, static_cast<Index>(vertices - 300));
      EXPECT_EQ(bits_of(vtp.doubles("Points", "Points", 3)), bits_of(sample.positions));
      EXPECT_EQ(bits_of(vtp.doubles("PointData", "distance", 1)), bits_of(sample.distance));
      EXPECT_EQ(bits_of(vtp.doubles("CellData", "normal", 3)), bits_of(sample.normals));
      EXPECT_EQ(bits_of(vtp.doubles("CellData", "heat", 1)), bits_of(sample.heat));
      EXPECT_EQ(vtp.parts("CellData", "normal"), (std::vector<std::string>{"nx", "ny", "nz"}));
      EXPECT_EQ(vtp.parts("CellData", "heat").size(), 0U);
      EXPECT_EQ(vtp.integers("Polys", "connectivity"),
                std::vector<Index>(sample.corners.begin(), sample.corners.end()));
      std::vector<Index> ends;
      for (Index f = 0; f < sample.result.mesh.faces(); ++f) {
        ends.push_back(sample.result.mesh.first_corner(f + 1));
      }
      EXPECT_EQ(vtp.integers("Polys", "offsets"), ends);
    }
  }
}

TEST_F(ResultFiles, CsvReadsBackToTheSameBits) {
  const Sample sample(true);
  EXPECT_EQ(write_result(path("a.csv"), sample.result),
            (std::vector<std::string>{"normal", "heat"}));
  const test::CsvFile csv = test::read_csv(path("a.csv"));
  EXPECT_EQ(csv.header, (std::vector<std::string>{"x", "y", "z", "distance"}));
  ASSERT_EQ(csv.rows.size(), 1000U);
  std::vector<double> positions, distance;
  for (const auto& row : csv.rows) {
    positions.insert(positions.end(), row.begin(), row.begin() + 3);
    distance.push_back(row.at(3));
  }
  EXPECT_EQ(bits_of(positions), bits_of(sample.positions));
  EXPECT_EQ(bits_of(distance), bits_of(sample.distance));
}

TEST_F(ResultFiles, CsvRowsAreFacesWhereTheFirstFieldIs) {
  Sample sample(true, 8, 5);
  for (std::size_t i = 0; i < sample.positions.size(); ++i) {
    sample.positions[i] = static_cast<double>(i) / 4;
  }
  std::swap(sample.result.fields[0], sample.result.fields[1]);
  EXPECT_EQ(write_result(path("a.csv"), sample.result), std::vector<std::string>{"distance"});
  const test::CsvFile csv = test::read_csv(path("a.csv"));
  EXPECT_EQ(csv.header, (std::vector<std::string>{"x", "y", "z", "nx", "ny", "nz", "heat"}));
  ASSERT_EQ(csv.rows.size(), 5U);
  for (std::size_t f = 0; f < 5; ++f) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double sum = 0;  // quarters of small integers: exact
      for (std::size_t c = 0; c < 4; ++c) {
        sum += sample.positions[3 * static_cast<std::size_t>(sample.corners[4 * f + c]) + axis];
      }
      EXPECT_EQ(csv.rows[f][axis], sum / 4);
    }
    EXPECT_EQ(csv.rows[f][6], sample.heat[f]);
  }
}

TEST_F(ResultFiles, AreTheSameBytesForAnyThreadCount) {
  const Sample sample(false, 50000, 40000);
  for (const std::string ending : {".ply", ".vtp", ".csv"}) {
    std::string reference;
    for (const int threads : {1, 2, 5}) {
      write_result(path("a" + ending), sample.result, Context{threads, nullptr});
      std::ifstream file(path("a" + ending), std::ios::binary);
      const std::string bytes((std::istreambuf_iterator<char>(file)), {});
      if (threads == 1) reference = bytes;
      EXPECT_TRUE(bytes == reference) << ending << " with " << threads << " threads";
    }
  }
}

TEST_F(ResultFiles, AnEmptyMeshIsAValidFile) {
  write_result(path("a.ply"), {});
  write_result(path("a.vtp"), {});
  write_result(path("a.csv"), {});
  EXPECT_TRUE(test::read_ply(path("a.ply")).faces.empty());
  EXPECT_EQ(test::read_vtp(path("a.vtp")).points, 0);
  EXPECT_TRUE(test::read_csv(path("a.csv")).rows.empty());
}

TEST_F(ResultFiles, EndingsInUpperCaseAreKnown) {
  write_result(path("a.PLY"), Sample(true).result);
  EXPECT_EQ(test::read_ply(path("a.PLY")).faces.size(), 700U);
}

/// Expects a throw of `Error` whose message contains every one of `words`, and no file.
#define EXPECT_REFUSED(statement, Error, ...)                                             \
  try {                                                                                   \
    statement;                                                                            \
    ADD_FAILURE() << "accepted";                                                          \
  } catch (const Error& error) {                                                          \
    for (const std::string word : {__VA_ARGS__}) {                                        \
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what(); \
    }                                                                                     \
  }                                                                                       \
  EXPECT_EQ(files(), 0U)

TEST_F(ResultFiles, AnUnknownEndingIsRefusedNamingTheKnownOnes) {
  EXPECT_REFUSED(check_result_path(path("a.xyz")), UsageError, ".xyz", ".ply", ".vtp", ".csv");
  EXPECT_REFUSED(check_result_path(path("noending")), UsageError, "noending", ".ply");
  EXPECT_REFUSED(write_result(path("a.dae"), {}), UsageError, ".dae", ".vtp");
}

TEST_F(ResultFiles, AMissingFolderIsRefusedBeforeAnythingIsComputed) {
  EXPECT_REFUSED(check_result_path(path("missing/a.ply")), OutputError, "missing",
                 "does not exist");
}

TEST_F(ResultFiles, NanIsRefusedNamingFieldAndPlace) {
  Sample sample(true);
  sample.normals[3 * 41 + 1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_REFUSED(write_result(path("a.ply"), sample.result), InputError, "normal", "face 41");
  sample.positions[3 * 17] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_REFUSED(write_result(path("a.vtp"), sample.result), InputError, "position", "vertex 17");
}

TEST_F(ResultFiles, AFieldOfAnotherSizeOrNameIsRefused) {
  Sample sample(true);
  Result result = sample.result;
  result.fields[0].values = result.fields[0].values.first(999);
  EXPECT_REFUSED(write_result(path("a.ply"), result), UsageError, "distance", "999",
                 "1000 vertices");
  result = sample.result;
  result.fields[0].parts = {"a b"};
  EXPECT_REFUSED(write_result(path("a.ply"), result), UsageError, "a b");
  result.fields[0].parts = {"x"};
  EXPECT_REFUSED(write_result(path("a.csv"), result), UsageError, "'x'");
  result = sample.result;
  result.fields.push_back(result.fields[0]);
  EXPECT_REFUSED(write_result(path("a.csv"), result), UsageError, "distance");
}

/// Asks for an end as soon as bytes have been written.
struct StopWhenWriting : Monitor {
  void advance(Index) noexcept override { cancel(); }
};

TEST_F(ResultFiles, AFailureLeavesWhatWasThere) {
  const Sample sample(true, 200000, 200000);
  for (const std::string ending : {".ply", ".vtp", ".csv"}) {
    std::ofstream(path("a" + ending)) << "old";
    StopWhenWriting monitor;
    EXPECT_THROW(write_result(path("a" + ending), sample.result, Context{1, &monitor}), Cancelled);
    std::ifstream file(path("a" + ending));
    std::string text;
    file >> text;
    EXPECT_EQ(text, "old");
  }
  EXPECT_EQ(files(), 3U) << "a temporary file was left";
}

}  // namespace
}  // namespace dsc
