// Pictures and .glb files take at most the memory that they ask for, and at least a third of it.
#include "tests/support/stage_memory.h"
#include "libdsc/render/glb_file.h"
#include "libdsc/render/picture.h"
#include "libdsc/render/png_file.h"
#include "tests/render/meshes.h"

namespace dsc::render {
namespace {

using test::OwnMesh;

PictureOptions sized(int width, int height) {
  PictureOptions options;
  options.width = width;
  options.height = height;
  return options;
}

void draw_quads(const Context& context) {
  const OwnMesh mesh = test::front_plane(3, 2, 700);
  const Eigen::VectorXd heights = mesh.positions.row(2);
  (void)draw(mesh.view(), scalar_field("height", FieldOn::vertex, heights), sized(300, 200),
             context);
}

void draw_arrows(const Context& context) {
  const OwnMesh mesh = test::front_plane(3, 2, 50);
  const Eigen::Matrix3Xd flow = Eigen::Matrix3Xd::Constant(3, mesh.view().faces(), 1.);
  PictureOptions options = sized(600, 400);
  options.glyphs = 3000;
  (void)draw(mesh.view(),
             vector_field("flow", {"x", "y", "z"}, FieldOn::face, {flow.data(), flow.cols()}),
             options, context);
}

void draw_large(const Context& context) {
  PictureOptions options = sized(5000, 4000);
  options.samples = 1;
  const OwnMesh mesh = test::front_plane(3, 2, 2);
  const Picture picture = draw(mesh.view(), options, context);
  (void)png_bytes(picture.image, context);
}

void write_models(const Context& context) {
  const TemporaryFolder folder;
  const OwnMesh mesh = test::front_plane(3, 2, 400);
  const Eigen::VectorXd heights = mesh.positions.row(2);
  (void)write_glb(folder / "vertices.glb",
                  {mesh.view(), {scalar_field("height", FieldOn::vertex, heights)}}, context);
  context.need("between", 0);
  (void)write_glb(folder / "corners.glb", {mesh.view(), {}}, context);
}

const testing::StageRuns kRuns = {{"quads", draw_quads},
                                  {"arrows", draw_arrows},
                                  {"large", draw_large},
                                  {"models", write_models}};

TEST(StageMemory, DISABLED_Child) { testing::record_stages(kRuns); }

TEST(StageMemory, IsAtMostWhatIsAskedForAndAtLeastAThird) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers take memory of their own";
#endif
  EXPECT_EQ(testing::expect_stages_within(kRuns, DSC_TEST_PROGRAM, "StageMemory.DISABLED_Child"),
            (std::set<std::string>{"draw", "write"}));
}

}  // namespace
}  // namespace dsc::render
