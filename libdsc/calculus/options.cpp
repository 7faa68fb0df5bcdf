#include "libdsc/calculus/options.h"

#include "libdsc/base/error.h"

#include <cmath>
#include <string>

namespace dsc {

void CalculusOptions::check() const {
  if (!std::isfinite(lambda) || lambda <= 0.) {
    throw UsageError("lambda is " + std::to_string(lambda) +
                     " but must be > 0; Stabilization::mercat stands for 0");
  }
  if (!(min_cosine > 0. && min_cosine <= 1.)) {
    throw UsageError("min_cosine is " + std::to_string(min_cosine) + " but must lie in (0, 1]");
  }
}

}  // namespace dsc
