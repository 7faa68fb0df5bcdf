/// \file
/// The Laplacian by convolution with the heat kernel, which converges pointwise on digital surfaces
/// (Caissard, Coeurjolly, Lachaud, Roussillon 2019):
///
/// \f[ (L f)(s) = \frac{1}{4\pi t^2} \sum_r e^{-|r - s|^2/4t}\,(f(r) - f(s))\,\mu(r), \f]
///
/// r, s over the centres of the faces, μ(r) the area of the face after projection along its
/// estimated normal, |·| the distance in space. It converges for t = Θ(h^α) with α < 1/2, at the
/// price of many neighbours: about 4π·25 t/h² terms a face. The sum is cut off where the kernel is
/// below 4·10⁻⁶; a spatial hash finds the terms, and no matrix is stored.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/calculus/options.h"
#include "libdsc/surface/flat_mesh.h"

#include <Eigen/Geometry>

#include <vector>

namespace dsc {

/// Built once for a surface and a time, then applied to any number of functions.
class HeatKernelLaplacian {
 public:
  /// On the faces of `mesh`; `time` is t > 0, in length squared. For shapes of unit size t = 0.1
  /// h^0.4 serves well. \throws UsageError on a time that is not positive and finite, and as
  /// assemble_laplacian() does.
  HeatKernelLaplacian(const FlatMesh& mesh, double time, const CalculusOptions& options = {},
                      const Context& context = {});

  /// L f per face, pointwise, in f's unit over length squared; `f` has a value per face, at its
  /// centre. The same bits for any thread count. \throws UsageError where f has another length than
  /// F, InputError where a value is not finite.
  Eigen::VectorXd apply(const Eigen::VectorXd& f, const Context& context = {}) const;

  /// F.
  Index faces() const { return static_cast<Index>(face_.size()); }
  /// t, as given.
  double time() const { return time_; }
  /// μ, a value per face. Σ_s μ(s) (L f)(s) = 0.
  Eigen::VectorXd masses() const;
  /// Faces whose normal was tilted back (embedding.h).
  Index clamped_faces() const { return clamped_faces_; }

 private:
  /// The sum at sorted place s of `values`, which are sorted too.
  double sum_at(Index s, const double* values) const;

  double time_;
  double cutoff_;
  Index clamped_faces_ = 0;

  // Faces sorted by cell, x fastest, so that a row of cells is a run of faces.
  Eigen::AlignedBox3d box_;
  Vec3 inverse_cell_;  ///< one over the edges of a cell
  Index3 cells_{1, 1, 1};
  std::vector<Index> first_;  ///< of each cell, and one past the end
  std::vector<Index> face_;   ///< by sorted place
  std::vector<double> x_, y_, z_, mass_;
};

}  // namespace dsc
