#include "libdsc/cli/statistics.h"

#include "libdsc/base/error.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace dsc::cli {

Statistics statistics_of(const Eigen::VectorXd& values) {
  Statistics s;
  long double sum = 0;  // its range holds sums and squares of any doubles
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
  if (s.finite > 0) s.mean = static_cast<double>(sum / static_cast<long double>(s.finite));
  return s;
}

ErrorNorms error_norms(const Eigen::VectorXd& values, const Eigen::VectorXd& truth) {
  ErrorNorms norms;
  long double sum = 0;
  long double squares = 0;
  long double count = 0;
  for (Index i = 0; i < values.size(); ++i) {
    if (std::isfinite(values[i]) != std::isfinite(truth[i])) {
      throw InputError("value " + std::to_string(i) + " is " + std::to_string(values[i]) +
                       " where the known answer is " + std::to_string(truth[i]));
    }
    if (!std::isfinite(values[i])) continue;
    const double error = std::abs(values[i] - truth[i]);
    sum += error;
    norms.max = std::max(norms.max, error);
    squares += static_cast<long double>(error) * error;
    count += 1;
  }
  if (count > 0) {
    norms.mean = static_cast<double>(sum / count);
    norms.l2 = static_cast<double>(std::sqrt(squares / count));
  }
  return norms;
}

ErrorNorms error_norms(const Eigen::VectorXd& errors) {
  return error_norms(errors, Eigen::VectorXd::Zero(errors.size()));
}

ErrorNorms error_norms(const Eigen::VectorXd& errors, const std::vector<char>& known) {
  std::vector<double> kept;
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (known[i] != 0) kept.push_back(errors[static_cast<Index>(i)]);
  }
  ErrorNorms norms = error_norms(
      Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(kept.data(), std::ssize(kept))));
  norms.left_out = std::ssize(known) - std::ssize(kept);
  return norms;
}

}  // namespace dsc::cli
