#include "libdsc/cli/measured_shape.h"

#include "libdsc/base/error.h"
#include "libdsc/base/parallel.h"

namespace dsc::cli {
namespace {

/// Faces that close the surface where the shape goes on: their outer voxel lies beyond the lattice
/// points that were digitised (digitize.h), and is inside of the shape too.
Index closing_faces(const ImplicitShape& shape, const DigitalSurface& surface,
                    const Context& context) {
  const Grid& grid = surface.grid();
  const Index margin = shape.closed() ? 1 : 0;
  const auto goes_on = [&](const Surfel& s) {
    const auto axis = static_cast<std::size_t>(s.axis());
    Index3 outer{s.x, s.y, s.z};
    outer[axis] += s.sign();
    if (outer[axis] >= margin && outer[axis] < grid.size[axis] - margin) return false;
    try {
      return shape.value(grid.position(static_cast<double>(outer[0]), static_cast<double>(outer[1]),
                                       static_cast<double>(outer[2]))) < 0;
    } catch (const InputError&) {  // an expression without a value beyond its box
      return true;
    }
  };
  return parallel_reduce(
      context, surface.face_count(), Index{1} << 12, Index{0},
      [&](Index first, Index last) {
        Index count = 0;
        for (Index f = first; f < last; ++f) {
          if (goes_on(surface.surfels()[static_cast<std::size_t>(f)])) ++count;
        }
        return count;
      },
      [](Index a, Index b) { return a + b; });
}

}  // namespace

const ImplicitShape* measured_shape(const Scene& scene, Run& run) {
  const ImplicitShape* shape = scene.input.shape.get();
  if (shape == nullptr) return nullptr;
  const Index closing = closing_faces(*shape, scene.surface, run.context);
  if (closing == 0) return shape;
  run.warn("no error is given: " + std::to_string(closing) + " of " +
           std::to_string(scene.surface.face_count()) +
           " faces lie on the sides of the box that cuts the shape, and the exact answer is not "
           "known for such a surface");
  return nullptr;
}

Eigen::Matrix3Xd face_centres(const DigitalSurface& surface) {
  Eigen::Matrix3Xd centres(3, surface.face_count());
  Index f = 0;
  for (const Surfel& surfel : surface.surfels()) centres.col(f++) = surfel.centre(surface.grid());
  return centres;
}

void warn_of_left_out(Run& run) {
  if (!run.report.error || run.report.error->left_out == 0) return;
  run.warn("left out of the error: " + std::to_string(run.report.error->left_out) +
           ", where no closest point of the shape, or no normal there, was found");
}

}  // namespace dsc::cli
