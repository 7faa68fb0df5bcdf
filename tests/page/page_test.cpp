// The file that write_page() makes, read back.
#include "libdsc/page/page.h"

#include "libdsc/base/error.h"
#include "libdsc/surface/digital_surface.h"
#include "libdsc/surface/extract.h"
#include "libdsc/voxels/digitize.h"
#include "libdsc/voxels/shapes.h"
#include "tests/io/temporary_folder.h"
#include "tests/page/page_reader.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace dsc {
namespace {

/// Triangles, a quad and a pentagon around some vertices; values of both kinds.
struct Polygons {
  Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Random(3, 9);
  std::vector<VertexId> corners{0, 1, 2, 2, 1, 3, 4, 5, 6, 7, 8, 0, 0, 2, 1};
  std::vector<Index> offsets{0, 3, 7, 12, 15};
  Eigen::VectorXd heat = Eigen::VectorXd::Random(9);
  Eigen::Matrix3Xd flow = Eigen::Matrix3Xd::Random(3, 4);

  Result result() const {
    Result r;
    r.mesh.positions = {points.data(), points.cols()};
    r.mesh.corners = corners;
    r.mesh.offsets = offsets;
    r.fields = {
        scalar_field("heat", FieldOn::vertex, heat),
        vector_field("flow", {"fx", "fy", "fz"}, FieldOn::face, {flow.data(), flow.cols()})};
    return r;
  }
};

TEST(Page, HoldsPolygonsOfAnySize) {
  const TemporaryFolder folder;
  const Polygons p;
  write_page(folder / "p.html", p.result());
  const test::PageFile page(folder / "p.html");
  const auto& m = page.manifest();
  EXPECT_EQ(m["vertices"], 9);
  EXPECT_EQ(m["faces"], 4);
  EXPECT_EQ(m["sides"], 0);
  EXPECT_EQ(m["fields"][1]["parts"], (std::vector<std::string>{"fx", "fy", "fz"}));
  EXPECT_EQ(test::unpacked(page.block("corners"), 1), p.corners);
  EXPECT_EQ(test::unpacked(page.block("sizes"), 1), (std::vector<std::int32_t>{3, 4, 5, 3}));
  const auto flow = test::unpacked(page.block("field1"), 3);
  for (std::size_t i = 0; i < flow.size(); ++i) {
    EXPECT_EQ(std::bit_cast<float>(flow[i]), static_cast<float>(p.flow.data()[i]));
  }
}

TEST(Page, HoldsADigitalSurface) {
  const TemporaryFolder folder;
  const DigitalSurface surface = extract_surface(digitize(Sphere(1.), {0.1, 0.1, 0.2}));
  write_page(folder / "s.html", {surface.flat(), {}});
  const test::PageFile page(folder / "s.html");
  const auto& m = page.manifest();
  EXPECT_EQ(m["sides"], 4);
  ASSERT_EQ(m["lattice"], true);
  const auto corners = test::unpacked(page.block("corners"), 4);
  const FlatMesh flat = surface.flat();
  EXPECT_TRUE(std::equal(corners.begin(), corners.end(), flat.corners.begin(), flat.corners.end()));
  const auto k = test::unpacked(page.block("positions"), 3);
  for (Index v = 0; v < flat.vertices(); ++v) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double x = m["origin"][axis].get<double>() +
                       m["step"][axis].get<double>() * k[static_cast<std::size_t>(3 * v) + axis];
      EXPECT_NEAR(x, flat.positions[v][static_cast<Index>(axis)], 1e-10);
    }
  }
}

TEST(Page, TakesNothingFromTheNetwork) {
  const TemporaryFolder folder;
  write_page(folder / "p.html", Polygons().result());
  const std::string text = read_all(folder / "p.html");
  for (const char* door :
       {"src=", "import(", "import ", "fetch(", "XMLHttpRequest", "@import", "url("}) {
    EXPECT_EQ(text.find(door), std::string::npos) << door;
  }
}

TEST(Page, ANameIsATitleWhateverItsLetters) {
  const TemporaryFolder folder;
  const std::string path = folder / "a <script> & \"b\".html";
  write_page(path, Polygons().result());
  const test::PageFile page(path);
  EXPECT_EQ(page.manifest()["title"], "a <script> & \"b\"");
  EXPECT_NE(page.text().find("<title>a &lt;script> &amp; \"b\"</title>"), std::string::npos);
}

TEST(Page, IsTheSameForAnyNumberOfThreads) {
  const TemporaryFolder folder;
  const Polygons p;
  write_page(folder / "p.html", p.result(), {1, nullptr});
  const std::string one = read_all(folder / "p.html");
  write_page(folder / "p.html", p.result(), {4, nullptr});
  EXPECT_EQ(read_all(folder / "p.html"), one);
}

TEST(Page, RefusesWhatResultsRefuse) {
  const TemporaryFolder folder;
  Polygons p;
  write_all(folder / "p.html", "before");
  p.heat[3] = std::nan("");
  EXPECT_THROW(write_page(folder / "p.html", p.result()), InputError);
  p.heat[3] = 0;
  p.corners[2] = 9;
  EXPECT_THROW(write_page(folder / "p.html", p.result()), InputError);
  EXPECT_THROW(write_page(folder / "no" + std::string("/p.html"), p.result()), OutputError);
  EXPECT_EQ(read_all(folder / "p.html"), "before");
}

TEST(Page, ACancelledRunLeavesTheFile) {
  const TemporaryFolder folder;
  write_all(folder / "p.html", "before");
  Monitor monitor;
  monitor.cancel();
  EXPECT_THROW(write_page(folder / "p.html", Polygons().result(), {1, &monitor}), Cancelled);
  EXPECT_EQ(read_all(folder / "p.html"), "before");
}

TEST(PagePath, IsKnownByItsEnding) {
  for (const char* path : {"a.html", "b/c.HTM", "x.y.Html"}) EXPECT_TRUE(is_page_path(path));
  for (const char* path : {"a.htmlx", "html", "a.vtp", ""}) EXPECT_FALSE(is_page_path(path));
}

}  // namespace
}  // namespace dsc
