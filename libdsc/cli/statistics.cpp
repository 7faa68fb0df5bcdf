#include "libdsc/cli/statistics.h"

#include "libdsc/base/error.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace dsc::cli {

Statistics statistics_of(const Eigen::VectorXd& values) {
  Statistics s;
  double sum = 0;
  for (const double value : values) {
    if (!std::isfinite(value)) {
      ++s.infinite;
      continue;
    }
    s.min = s.finite == 0 ? value : std::min(s.min, value);
    s.max = s.finite == 0 ? value : std::max(s.max, value);
    sum += value;
    ++s.finite;
  }
  if (s.finite > 0) s.mean = sum / static_cast<double>(s.finite);
  return s;
}

ErrorNorms error_norms(const Eigen::VectorXd& values, const Eigen::VectorXd& truth) {
  ErrorNorms norms;
  double squares = 0;
  double count = 0;
  for (Index i = 0; i < values.size(); ++i) {
    if (std::isfinite(values[i]) != std::isfinite(truth[i])) {
      throw InputError("value " + std::to_string(i) + " is " + std::to_string(values[i]) +
                       " where the known answer is " + std::to_string(truth[i]));
    }
    if (!std::isfinite(values[i])) continue;
    const double error = std::abs(values[i] - truth[i]);
    norms.mean += error;
    norms.max = std::max(norms.max, error);
    squares += error * error;
    count += 1;
  }
  if (count > 0) {
    norms.mean /= count;
    norms.l2 = std::sqrt(squares / count);
  }
  return norms;
}

ErrorNorms error_norms(const Eigen::VectorXd& errors) {
  return error_norms(errors, Eigen::VectorXd::Zero(errors.size()));
}

}  // namespace dsc::cli
