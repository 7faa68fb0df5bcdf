// The same bits for any number of threads; progress; an end on request.
#include "libdsc/normals/surface_normals.h"
#include "libdsc/render/picture.h"
#include "libdsc/surface/digital_surface.h"
#include "libdsc/surface/extract.h"
#include "libdsc/voxels/digitize.h"
#include "libdsc/voxels/shapes.h"

#include <gtest/gtest.h>

#include <atomic>

namespace dsc::render {
namespace {

DigitalSurface torus(double h) {
  const BinaryVolume voxels = digitize(Torus(), {h, h, h});
  DigitalSurface surface = extract_surface(voxels);
  trivial_normals(surface);
  return surface;
}

Eigen::VectorXd heights(const FlatMesh& mesh) {
  return mesh.positions.matrix().row(0).transpose() + mesh.positions.matrix().row(2).transpose();
}

TEST(Threads, AnyNumberOfThemDrawsTheSameBits) {
  const DigitalSurface surface = torus(0.06);
  const FlatMesh mesh = surface.flat();
  const Eigen::VectorXd phi = heights(mesh);
  const Field scalar = scalar_field("height", FieldOn::vertex, phi);
  const Field normals = vector_field("normal", {"nx", "ny", "nz"}, FieldOn::face, mesh.normals);
  // From the front and from above many rays run along faces and through edges.
  for (const char* view : {"front", "top", "iso", "31,17"}) {
    PictureOptions options;
    options.width = 300;
    options.height = 200;
    options.view = View::of(view);
    options.shading = Shading::flat;
    Context one;
    one.threads = 1;
    const Image expected = draw(mesh, scalar, options, one).image;
    options.glyphs = 60;
    const Image arrows = draw(mesh, normals, options, one).image;
    options.glyphs = 0;
    for (const int threads : {2, 3, 8}) {
      Context many;
      many.threads = threads;
      EXPECT_EQ(draw(mesh, scalar, options, many).image, expected) << view << ", " << threads;
      options.glyphs = 60;
      EXPECT_EQ(draw(mesh, normals, options, many).image, arrows) << view << ", " << threads;
      options.glyphs = 0;
    }
  }
}

class Watch : public Monitor {
 public:
  void begin(std::string_view, Index total) override { total_ = total; }
  void advance(Index units) noexcept override {
    done_ += units;
    if (stop_at_ > 0 && done_ >= stop_at_) cancel();
  }
  Index total_ = 0, stop_at_ = 0;
  std::atomic<Index> done_{0};
};

TEST(Progress, AllRowsAreCountedAndAnEndIsPossible) {
  const DigitalSurface surface = torus(0.1);
  PictureOptions options;
  options.width = 200;
  options.height = 150;
  Watch watch;
  draw(surface.flat(), options, {2, &watch});
  EXPECT_EQ(watch.total_, 150);
  EXPECT_EQ(watch.done_.load(), 150);
  Watch impatient;
  impatient.stop_at_ = 64;
  EXPECT_THROW(draw(surface.flat(), options, {2, &impatient}), Cancelled);
  Watch before;
  before.cancel();
  EXPECT_THROW(draw(surface.flat(), options, {2, &before}), Cancelled);
}

}  // namespace
}  // namespace dsc::render
