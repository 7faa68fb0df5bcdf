// Pages take at most the memory that they ask for, and at least a third of it.
#include "tests/support/stage_memory.h"
#include "libdsc/page/page.h"
#include "libdsc/surface/extract.h"
#include "libdsc/voxels/digitize.h"
#include "libdsc/voxels/shapes.h"

#include <random>

namespace dsc {
namespace {

/// `noise`: values that nothing shortens, the most that a page can hold.
void write_page_of(bool noise, const Context& context) {
  const TemporaryFolder folder;
  const DigitalSurface surface =
      extract_surface(digitize(Sphere(1.), {0.01, 0.01, 0.01}), {}, context);
  std::mt19937 random(1);
  Eigen::VectorXd values(surface.vertex_count());
  for (Index v = 0; v < values.size(); ++v) {
    values[v] = noise ? std::uniform_real_distribution<double>(-1, 1)(random)
                      : surface.flat().positions[v][2];
  }
  Result result{surface.flat(), {}};
  for (const char* name : {"a", "b", "c"}) {
    result.fields.push_back(scalar_field(name, FieldOn::vertex, values));
  }
  context.need("between", 0);
  write_page(folder / "page.html", result, context);
}

const testing::StageRuns kRuns = {
    {"smooth", [](const Context& context) { write_page_of(false, context); }},
    {"noise", [](const Context& context) { write_page_of(true, context); }},
    {"two-threads", [](const Context& context) {
       write_page_of(true, {2, context.monitor, context.memory});
     }}};

TEST(StageMemory, DISABLED_Child) { testing::record_stages(kRuns); }

TEST(StageMemory, IsAtMostWhatIsAskedForAndAtLeastAThird) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers take memory of their own";
#endif
  EXPECT_EQ(testing::expect_stages_within(kRuns, DSC_TEST_PROGRAM, "StageMemory.DISABLED_Child")
                .count("page"),
            1U);
}

}  // namespace
}  // namespace dsc
