/// \file
/// A few numbers that sum up many.
#pragma once

#include "libdsc/base/types.h"

#include <vector>

namespace dsc::cli {

/// Over the finite values; the infinite ones are counted beside. All 0 where none is finite.
struct Statistics {
  double min = 0;
  double max = 0;
  double mean = 0;
  Index finite = 0;
  Index infinite = 0;
};
Statistics statistics_of(const Eigen::VectorXd& values);

/// Of absolute errors: their mean, their maximum, the root of the mean of their squares.
struct ErrorNorms {
  double mean = 0;
  double max = 0;
  double l2 = 0;
  Index left_out = 0;  ///< values whose truth is not known
};
/// Of the differences between `values` and `truth`, where both are finite. \throws InputError
/// where a value is finite and its truth is not, or the other way round, naming the first.
ErrorNorms error_norms(const Eigen::VectorXd& values, const Eigen::VectorXd& truth);
/// Of errors as they are, finite.
ErrorNorms error_norms(const Eigen::VectorXd& errors);
/// Of those errors whose `known` is not 0; the others are counted.
ErrorNorms error_norms(const Eigen::VectorXd& errors, const std::vector<char>& known);

}  // namespace dsc::cli
