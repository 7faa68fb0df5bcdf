/// \file
/// The sparse factorization P A Pᵀ = L D Lᵀ itself: what the default solver owns, and what the heat
/// method solves with where values leave double's range.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/base/types.h"
#include "libdsc/solve/wide_vector.h"

#include <memory>

namespace dsc {

/// How the unknowns are ordered to keep L sparse. Both give the same order every time.
enum class FillOrder {
  nested_dissection,  ///< METIS: less fill on large surfaces; one call at a time in a process
  minimum_degree,     ///< AMD: fast, good for narrow bands; calls run side by side
};

/// The factorization of one matrix, which is not kept; solves are const and may run side by side.
class LdltFactor {
 public:
  /// Only A's lower triangle is read; n may be 0.
  /// \throws SolverError unless every pivot exceeds the rounding of its own diagonal entry,
  /// (n + 10) epsilon a_ii: A is singular, indefinite or not finite; LimitError where L does not
  /// fit memory or 32-bit indices: its nonzeros are counted before it is made.
  explicit LdltFactor(const SparseMatrix& A, FillOrder order = FillOrder::nested_dissection,
                      const Context& context = {});
  ~LdltFactor();
  LdltFactor(LdltFactor&&) noexcept;
  LdltFactor& operator=(LdltFactor&&) noexcept;

  /// n.
  Index size() const;
  /// Nonzeros of L below its diagonal.
  Index fill() const;

  /// x with A x = b.
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  /// The same in place, where b spans more than double's range. For an M-matrix and b >= 0 nothing
  /// cancels, and every entry comes out accurate relative to itself.
  void solve_in_place(WideVector& b) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace dsc
