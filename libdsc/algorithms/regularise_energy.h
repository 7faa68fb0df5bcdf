/// \file
/// \internal
/// The quadratic form of regularise.h and its products with vectors, vertex by vertex.
#pragma once

#include "libdsc/algorithms/regularise.h"

#include <vector>

namespace dsc {

/// Half the energy's Hessian,
///     A x = α x + β Σ_f Σ_e (e·u_f) … + γ Bᵀ B x,   B x at v = x_v − the mean over v's neighbours,
/// so that the minimum solves A p̂ = α p. Vectors are 3 V doubles, x, y, z of vertex 0 first.
class RegulariseEnergy {
 public:
  RegulariseEnergy(const FlatMesh& mesh, const RegulariseOptions& options, const Context& context);

  void apply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const;
  /// The inverses of A's 3 × 3 blocks on the diagonal.
  void precondition(const Eigen::VectorXd& r, Eigen::VectorXd& z) const;

  double mean_edge() const { return mean_edge_; }

 private:
  /// v's neighbour along an edge, with the entries of B at (v, vertex) and (vertex, v), negated.
  struct Neighbour {
    VertexId vertex;
    double here, there;
  };
  /// A corner of a face at v, with the vertices before and after it.
  struct Corner {
    VertexId before, after;
    Index face;
  };

  void find_neighbours();
  void find_corners();
  void invert_blocks();
  /// B x at v.
  Vec3 unevenness(const Eigen::VectorXd& x, Index v) const;

  const FlatMesh& mesh_;
  RegulariseOptions options_;
  Context context_;
  std::vector<Index> first_neighbour_, first_corner_;  ///< V + 1
  std::vector<Neighbour> neighbours_;
  std::vector<Corner> corners_;
  std::vector<Mat3> inverse_blocks_;
  double mean_edge_ = 0;
};

}  // namespace dsc
