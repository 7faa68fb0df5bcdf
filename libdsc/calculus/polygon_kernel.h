/// \file
/// The calculus on a general polygon, without matrices and without an allocation a face.
///
/// With unit normal u of the projected face, area a, edges e(i) = x(i+1) − x(i) and g(j) = G's
/// column j:
///     g(j)  = (x(j+1) − x(j−1)) × u / (2a)
///     L(ij) = −(a g(i)·g(j) + λ [DᵀPᵀPD](ij)),  PD(kj) = D(kj) − e(k)·g(j)
///     Div V = −a Gᵀ, since P V = 0
/// The corners need no projection: every product is with a vector across u. O(n²) for n corners.
#pragma once

#include "libdsc/calculus/options.h"
#include "libdsc/calculus/surfel_operators.h"
#include "libdsc/surface/flat_mesh.h"

#include <Eigen/Geometry>

#include <vector>

namespace dsc {

/// One face at a time of a mesh that check_mesh() has passed; used by one thread.
class PolygonKernel {
 public:
  /// Both must outlive it. No face is current yet.
  PolygonKernel(const FlatMesh& mesh, const CalculusOptions& options);

  /// Makes `face` the current one. \throws InputError naming it where a corner, the area or the
  /// normal is unusable.
  void load(Index face);

  Index corners() const { return static_cast<Index>(edges_.size()); }  ///< n
  double area() const { return area_; }                                ///< a, after projection
  const Vec3& normal() const { return u_; }                            ///< u
  /// Whether the normal was tilted back (embedding.h).
  bool clamped() const { return clamped_; }
  double lambda() const { return lambda_; }  ///< λ_f

  /// e(i) = x(i+1) − x(i), not projected.
  const Vec3& edge(Index i) const { return edges_[static_cast<std::size_t>(i)]; }
  /// x(j+1) − x(j−1), so that a Gᵀd at j is ½ (chord(j) × u)·d.
  Vec3 chord(Index j) const { return edge(j) + edge(j == 0 ? corners() - 1 : j - 1); }
  Vec3 gradient(Index j) const { return chord(j).cross(u_) / (2. * area_); }  ///< column j of G
  Vec3 flat(Index i) const { return edge(i) - edge(i).dot(u_) * u_; }         ///< row i of V
  Vec3 sharp(Index i) const;                                                  ///< column i of U

  /// Writes L, n × n.
  void laplacian(double* L);
  /// Writes M1, n × n.
  void mass1(double* M1);

 private:
  const FlatMesh& mesh_;
  const CalculusOptions& options_;
  std::array<SurfelShape, 6> shapes_;
  std::vector<Vec3> corners_;  ///< relative to the first
  std::vector<Vec3> edges_;
  std::vector<Vec3> columns_, products_;  ///< scratch of the n × n operators
  Vec3 mean_ = Vec3::Zero();              ///< of corners_
  Vec3 u_ = Vec3::UnitZ();
  double area_ = 0.;
  double lambda_ = 0.;
  bool clamped_ = false;
};

}  // namespace dsc
