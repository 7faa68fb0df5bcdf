/// \file
/// \internal
/// The levels of the multigrid preconditioner and its V-cycle.
///
/// Every level keeps its matrix, scaled by one number, in single precision: a V-cycle is bound by
/// memory traffic, and the conjugate gradients around it make good what single precision loses.
/// The smoother is a Chebyshev polynomial in D^-1 A with D_ii = sum_j |a_ij|: the eigenvalues of
/// D^-1 A are at most 1 whatever the signs of the couplings, so it can never amplify.
#pragma once

#include "libdsc/solve/matrix_components.h"
#include "libdsc/solve/multigrid.h"
#include "libdsc/solve/sparse_rows.h"

#include <Eigen/SparseCholesky>

namespace dsc {

/// A symmetric positive semi-definite approximation of the inverse of A.
class MultigridHierarchy {
 public:
  /// \param a symmetric rows; must outlive the hierarchy, which shares its index arrays.
  /// \throws SolverError where a level's matrix turns out indefinite.
  MultigridHierarchy(RowsView<double> a, const MatrixComponents& components,
                     const MultigridOptions& options, const Context& context);

  /// Vectors of one solve; a hierarchy serves several solves at once, each with its own.
  class Workspace {
    friend class MultigridHierarchy;
    struct Vectors {
      std::vector<float> rhs, x, next, direction;
    };
    std::vector<Vectors> levels_;
    Eigen::VectorXd coarse_;
  };
  Workspace workspace() const;

  /// z = M r, M symmetric. \param r, z as many values as A has rows.
  void apply(const double* r, double* z, Workspace& workspace, const Context& context) const;

  int levels() const { return static_cast<int>(levels_.size()); }
  Index nonzeros() const;
  /// Without the index arrays shared with A.
  Index bytes() const;

 private:
  struct Level {
    std::vector<int> start, column;  // empty on the finest level: those of A
    std::vector<float> value;
    std::vector<float> inverse_diagonal;          // of D; 0 for empty rows
    SparseRows<float> prolongation, restriction;  // to and from the next level; empty on the last
    double largest_eigenvalue = 1.0;
    RowsView<float> a;
  };

  void add_level(RowsView<double> a, bool finest, const Context& context);
  void factorize(RowsView<double> a, const std::vector<int>& component,
                 const MatrixComponents& components);
  void smooth(const Level& level, Workspace::Vectors& v, bool from_zero,
              const Context& context) const;
  void cycle(std::size_t l, Workspace& workspace, const Context& context) const;

  MultigridOptions options_;
  double scale_ = 1.0;  // of the single precision matrices
  std::vector<Level> levels_;
  bool direct_ = false;  // whether the last level is solved by the factorization
  Eigen::SimplicialLDLT<SparseMatrix> factorization_;
};

}  // namespace dsc
