/// \file
/// The checkerboards that Stabilization::mercat, λ_f = 0, leaves in the kernel of the Laplacian.
///
/// A quad's gradient is that of its two diagonals' differences, and a triangle's that of all its
/// corners. So with λ_f = 0 the kernel of L is the functions that are constant on each class of
/// vertices joined by diagonals of quads and sides of triangles. On a digital surface each
/// component has two, the parities of i + j + k: their difference is the checkerboard. There are
/// more where parts of the surface hang together by single vertices, and fewer where a quad mesh
/// has no two colours.
///
/// How much of x is checkerboard is told face by face: S = Σ_f (a_f / 16) g gᵀ, g = (1, −1, 1, −1),
/// with 0 <= xᵀSx <= xᵀM0x, equal to the right where x alternates on every face, and of the order
/// of h⁴ where x is smooth.
#pragma once

#include "libdsc/calculus/options.h"
#include "libdsc/solve/components.h"
#include "libdsc/solve/dirichlet.h"

#include <optional>

namespace dsc {

/// The classes of vertices such that the kernel of the Laplacian is the functions constant on each:
/// the connected components where λ_f > 0, else as above. \throws UsageError where λ_f = 0 and a
/// face has five corners or more, since nothing simple is known of its kernel; InputError where a
/// corner is not a vertex id.
Components kernel_classes(const FlatMesh& mesh, Stabilization stabilization);

/// S, V × V, symmetric; 0 on triangles. \throws as assemble_laplacian and kernel_classes do.
SparseMatrix checkerboard_form(const FlatMesh& mesh, const CalculusOptions& options = {},
                               const Context& context = {});

/// Takes the checkerboards of the kernel out of functions: adds to each class the constant that
/// makes xᵀSx least, the components' means staying what they are. Where a component has two
/// classes, they get the same mean with respect to M0. The limit of λ_f a_f → 0, that is.
class CheckerboardFilter {
 public:
  /// \throws as checkerboard_form does.
  CheckerboardFilter(const FlatMesh& mesh, const CalculusOptions& options = {},
                     const Context& context = {});

  /// `x` and `mass`, the positive weights of the means, have V values.
  void remove(Eigen::VectorXd& x, const Eigen::VectorXd& mass) const;

 private:
  SparseMatrix S_;
  Components components_, classes_;
  std::optional<DirichletSolver> between_;  ///< S between the classes, one a component fixed
};

}  // namespace dsc
