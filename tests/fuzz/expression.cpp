#include "libdsc/voxels/expression.h"

#include "libdsc/base/error.h"
#include "tests/fuzz/fuzz.h"

#include <array>
#include <cmath>
#include <optional>

namespace dsc::fuzz {

/// A value at a point is finite or refused, and the same whoever evaluates it and how often.
void fuzz_expression(std::string_view bytes) {
  const std::string text(bytes);
  const Expression f(text);
  require(f.text() == text, "the text is kept");
  const std::array<Vec3, 3> points{Vec3(0, 0, 0), Vec3(0.5, -1.25, 3), Vec3(-1e3, 7, 1e-9)};
  const auto value_at = [&](const Vec3& p) -> std::optional<double> {
    try {
      return f(p);
    } catch (const InputError&) {
      return std::nullopt;
    }
  };
  bool all = true;
  for (const Vec3& p : points) {
    const std::optional<double> value = value_at(p);
    require(!value || std::isfinite(*value), "values are finite");
    require(value == value_at(p), "a value is the same the second time");
    all = all && value.has_value();
  }
  std::optional<Eigen::VectorXd> values;
  try {
    values = f(Vec3View{points[0].data(), 3}, Context{1, nullptr});
  } catch (const InputError&) {
  }
  require(values.has_value() == all, "many points are refused where one is");
  for (Index i = 0; values && i < 3; ++i) {
    require((*values)[i] == value_at(points[static_cast<std::size_t>(i)]),
            "many points have the values of each");
  }
}

}  // namespace dsc::fuzz
