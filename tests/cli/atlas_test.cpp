// Two atlases of the brain, from Debian's package mricron-data: real label images, one of them
// mirrored. What is expected of them is counted here, from the voxels.
#include "tests/cli/program.h"
#include "tests/io/result_parsers.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <set>

namespace dsc::test {
namespace {

constexpr const char* kFolder = "/usr/share/mricron/templates/";
constexpr const char* kAal = "aal.nii.gz";
constexpr const char* kHarvardOxford = "HarvardOxford-cort-maxprob-thr0-1mm.nii.gz";

/// The voxels of a NIfTI file of bytes, with a margin of zeros.
struct Voxels {
  long size[3];
  std::vector<unsigned char> values;

  explicit Voxels(const std::string& path) {
    gzFile file = gzopen(path.c_str(), "rb");
    std::vector<unsigned char> header(348);
    gzread(file, header.data(), 348);
    std::int16_t dims[4], type;
    float offset = 0;
    std::memcpy(dims, &header[40], 8);
    std::memcpy(&type, &header[70], 2);
    std::memcpy(&offset, &header[108], 4);
    if (type != 2) throw std::runtime_error(path + ": not of bytes");
    for (int a = 0; a < 3; ++a) size[a] = dims[a + 1] + 2;
    values.resize(static_cast<std::size_t>(size[0] * size[1] * size[2]), 0);
    gzseek(file, static_cast<z_off_t>(offset), SEEK_SET);
    for (long z = 1; z < size[2] - 1; ++z) {
      for (long y = 1; y < size[1] - 1; ++y) {
        gzread(file, &values[static_cast<std::size_t>(1 + size[0] * (y + size[1] * z))],
               static_cast<unsigned>(size[0] - 2));
      }
    }
    gzclose(file);
  }
};

struct Counts {
  long inside = 0, faces = 0, junctions = 0, three_faces = 0;
  std::set<int> labels;
};

/// By plain loops over faces and linels.
Counts count(const Voxels& v) {
  Counts counts;
  const long step[3] = {1, v.size[0], v.size[0] * v.size[1]};
  const auto n = static_cast<long>(v.values.size());
  for (long i = 0; i < n; ++i) {
    const int p = v.values[static_cast<std::size_t>(i)];
    counts.inside += p != 0 ? 1 : 0;
    if (p != 0) counts.labels.insert(p);
    for (int a = 0; a < 3; ++a) {
      if (i + step[a] >= n) continue;
      const int q = v.values[static_cast<std::size_t>(i + step[a])];
      counts.faces += p != q ? 1 : 0;
      for (int b = a + 1; b < 3; ++b) {
        if (i + step[a] + step[b] >= n) continue;
        const int r = v.values[static_cast<std::size_t>(i + step[b])];
        const int s = v.values[static_cast<std::size_t>(i + step[a] + step[b])];
        const int around = (p != q) + (r != s) + (p != r) + (q != s);
        if (around < 3) continue;
        counts.junctions += std::set<int>{p, q, r, s}.size() > 2 ? 1 : 0;
        counts.three_faces += around == 3 ? 1 : 0;
      }
    }
  }
  return counts;
}

class Atlas : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
#ifndef DSC_IMAGE_READER
    GTEST_SKIP() << "built without DSC_WITH_ITK";
#endif
    path_ = std::string(kFolder) + GetParam();
    if (!std::filesystem::exists(path_))
      GTEST_SKIP() << "the package mricron-data is not installed";
  }
  nlohmann::json report_of(Words arguments) {
    arguments.insert(arguments.begin() + 1, path_);
    arguments.insert(arguments.end(), {"--report", folder_ / "report.json"});
    const Outcome outcome = run_dsc(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.exit_code == 0 ? read_json(folder_ / "report.json") : nlohmann::json();
  }
  Folder folder_;
  std::string path_;
};

TEST_P(Atlas, InterfacesAndJunctionsAreThoseOfTheVoxels) {
  const Counts counts = count(Voxels(path_));
  const auto report = report_of({"info", "--labels", "all"});
  EXPECT_EQ(report["input"]["voxels_inside"], counts.inside);
  EXPECT_EQ(report["input"]["labels"], counts.labels.size());
  EXPECT_EQ(report["surface"]["faces"], counts.faces);
  EXPECT_EQ(report["surface"]["junction_edges"], counts.junctions);
  EXPECT_EQ(report["surface"]["boundary_edges"], 0);
  if (GetParam() == kAal) {
    // As counted by others before.
    EXPECT_EQ(counts.three_faces, 33058);
    EXPECT_EQ(counts.labels.size(), 116U);
  }
}

TEST_P(Atlas, DistancesCrossTheJunctionsAndAreFiniteWhereTheyReach) {
  const auto report =
      report_of({"geodesic", "--labels", "all", "--source", "0,-60,40", "-o", folder_ / "d.ply"});
  const PlyFile file = read_ply(folder_ / "d.ply");
  const auto distance = file.vertex_columns({"distance"});
  const auto labels = file.face_columns({"label_inner", "label_outer"});
  ASSERT_EQ(labels.size(), 2 * file.faces.size());
  // Reached are the vertices that faces connect to the source, and they alone.
  std::set<double> reached;
  long finite = 0;
  for (std::size_t f = 0; f < file.faces.size(); ++f) {
    int here = 0;
    for (const auto v : file.faces[f]) here += std::isfinite(distance[static_cast<std::size_t>(v)]);
    EXPECT_TRUE(here == 0 || here == 4) << f;
    if (here == 4) reached.insert({labels[2 * f], labels[2 * f + 1]});
  }
  for (const double d : distance) {
    EXPECT_FALSE(std::isnan(d));
    EXPECT_GE(d, 0);
    finite += std::isfinite(d) ? 1 : 0;
  }
  EXPECT_EQ(static_cast<long>(distance.size()) - finite, report["result"]["infinite"]);
  EXPECT_GT(finite, static_cast<long>(distance.size()) * 9 / 10);
  EXPECT_GT(reached.size(), 40U);  // regions
}

TEST_P(Atlas, TheWholeBrainHasItsNormalsTurnedOutwards) {
  report_of({"normals", "-o", folder_ / "n.ply"});
  const PlyFile file = read_ply(folder_ / "n.ply");
  const auto u = file.face_columns({"nx", "ny", "nz"});
  // Corners and normals agree, so that the flux of the position is three times the volume, and
  // positive: the surface is not inside out.
  double flux = 0;
  for (std::size_t f = 0; f < file.faces.size(); ++f) {
    const auto corner = [&](std::size_t c) {
      return file.vertices[static_cast<std::size_t>(file.faces[f][c])];
    };
    const auto a = corner(0), b = corner(1), d = corner(3);
    double area[3], dot = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      area[i] = (b[j] - a[j]) * (d[k] - a[k]) - (b[k] - a[k]) * (d[j] - a[j]);
      flux += area[i] * (a[i] + corner(2)[i]) / 2;
      dot += area[i] * u[3 * f + i];
    }
    ASSERT_GT(dot, -1e-9) << "face " << f;
  }
  const auto report = read_json(folder_ / "report.json");
  EXPECT_NEAR(flux / 3, report["input"]["voxels_inside"].get<double>(), 1e-3);
}

INSTANTIATE_TEST_SUITE_P(OfTheBrain, Atlas, ::testing::Values(kAal, kHarvardOxford),
                         [](const auto& atlas) {
                           return std::string(atlas.param == kAal ? "Aal" : "HarvardOxford");
                         });

}  // namespace
}  // namespace dsc::test
