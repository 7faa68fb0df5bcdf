#include "libdsc/calculus/options.h"

#include "libdsc/base/error.h"

#include <fmt/format.h>

#include <string>

namespace dsc {

void CalculusOptions::check() const {
  if (!(lambda > 0. && lambda <= 1e6)) {
    throw UsageError(
        fmt::format("lambda is {:g} but must lie in (0, 1e6], best in (0, 1]; "
                    "Stabilization::mercat stands for 0",
                    lambda));
  }
  if (!(min_cosine > 0. && min_cosine <= 1.)) {
    throw UsageError("min_cosine is " + std::to_string(min_cosine) + " but must lie in (0, 1]");
  }
}

}  // namespace dsc
