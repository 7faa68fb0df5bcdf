#include "libdsc/solve/fill_order.h"

#include "libdsc/base/error.h"

#include <iostream>  // which Eigen/MetisSupport forgets

#include <Eigen/MetisSupport>
#include <Eigen/OrderingMethods>

#include <mutex>

namespace dsc {

FillPermutation fill_order(const SparseMatrix& A, FillOrder order) {
  FillPermutation result;
  // METIS gains nothing on small systems, and wants a graph with edges.
  if (order == FillOrder::minimum_degree || A.cols() < 1000 || A.nonZeros() < 2 * A.cols()) {
    Eigen::AMDOrdering<int>()(A, result);
    return result;
  }
  // METIS draws from the C library's one random sequence, which it seeds anew at each call: one
  // call at a time, so that the order, and with it every bit of the solution, is always the same.
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  Eigen::MetisOrdering<int>()(A, result);
  if (result.size() != A.cols()) throw LimitError("METIS found no order: out of memory");
  return result;
}

}  // namespace dsc
