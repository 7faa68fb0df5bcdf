#include "libdsc/base/error.h"
#include "libdsc/voxels/shape_spec.h"
#include "tests/fuzz/fuzz.h"

#include <array>
#include <cmath>

namespace dsc::fuzz {

/// A shape has a box, values that do not depend on how they are asked for, and a name that makes it
/// again.
void fuzz_shape(std::string_view bytes) {
  const auto shape = make_shape(std::string(bytes));
  const Eigen::AlignedBox3d box = shape->bounds();
  require(box.min().allFinite() && box.max().allFinite(), "the box is finite");
  require((box.min().array() <= box.max().array()).all(), "the box is not empty");
  const std::string name = shape->name();
  const auto again = make_shape(name);
  require(again->name() == name, "the name makes the shape again");
  require(again->closed() == shape->closed() && again->bounds().min() == box.min() &&
              again->bounds().max() == box.max(),
          "the shape of the name has the same box");
  const double step = 0.25;
  std::array<double, 3> row{};
  try {
    shape->values_along_x(step, -1, 3, 0.5, -0.5, row.data());
    for (int k = 0; k < 3; ++k) {
      const Vec3 p(step * (k - 1), 0.5, -0.5);
      const double value = shape->value(p);
      const double other = again->value(p);
      require(value == other || (std::isnan(value) && std::isnan(other)),
              "the shape of the name has the same values");
      const double in_row = row[static_cast<std::size_t>(k)];
      require(value == in_row || (std::isnan(value) && std::isnan(in_row)),
              "a row has the values of its points");
      (void)shape->gradient(p);
      (void)shape->hessian(p);
    }
  } catch (const InputError&) {  // an expression that is not finite there
  }
}

}  // namespace dsc::fuzz
