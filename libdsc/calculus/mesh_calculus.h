/// \file
/// A mesh gathered into flat arrays, and the calculus on it: what on_mesh.h fills, compiled once.
#pragma once

#include "libdsc/calculus/assembly.h"
#include "libdsc/calculus/field_operators.h"
#include "libdsc/calculus/global_operators.h"

#include <vector>

namespace dsc {

/// A polygon mesh as arrays of its own; view() is what the calculus reads.
struct GatheredMesh {
  Eigen::Matrix3Xd positions;     ///< 3 × V
  std::vector<VertexId> corners;  ///< face after face
  std::vector<Index> offsets;     ///< F + 1
  Eigen::Matrix3Xd normals;       ///< 3 × F, or 3 × 0: naive

  /// Lives as long as this object.
  FlatMesh view() const {
    FlatMesh mesh;
    mesh.positions = {positions.data(), positions.cols()};
    mesh.corners = corners;
    mesh.offsets = offsets;
    mesh.normals = {normals.data(), normals.cols()};
    return mesh;
  }
};

/// Every operator on one gathered mesh, under one set of options. Shapes, units and errors are
/// those of the functions of the same name in global_operators.h, assembly.h and field_operators.h.
class MeshCalculus {
 public:
  /// \throws UsageError on options out of range; of the mesh the functions below tell.
  explicit MeshCalculus(GatheredMesh mesh, const CalculusOptions& options = {},
                        const Context& context = {})
      : mesh_(std::move(mesh)), options_(options), context_(context) {
    options_.check();
  }

  /// What the operators read; a view of this object.
  FlatMesh mesh() const { return mesh_.view(); }
  /// As given.
  const CalculusOptions& options() const { return options_; }

  /// L with the diagonal of M0, in one pass.
  LaplaceSystem laplace_system() const { return assemble_laplacian(mesh(), options_, context_); }
  /// L, V × V.
  SparseMatrix laplacian() const { return laplacian_matrix(mesh(), options_, context_); }
  /// M0, V × V.
  SparseMatrix mass0() const { return mass0_matrix(mesh(), options_, context_); }
  /// M1, C × C.
  SparseMatrix mass1() const { return mass1_matrix(mesh(), options_, context_); }
  /// D, C × V.
  SparseMatrix difference() const { return difference_matrix(mesh(), context_); }
  /// G, 3F × V.
  SparseMatrix gradient() const { return gradient_matrix(mesh(), options_, context_); }
  /// V, C × 3F.
  SparseMatrix flat() const { return flat_matrix(mesh(), options_, context_); }
  /// U, 3F × C.
  SparseMatrix sharp() const { return sharp_matrix(mesh(), options_, context_); }
  /// Div, V × C.
  SparseMatrix divergence() const { return divergence_matrix(mesh(), options_, context_); }

  /// G φ, 3 × F, of `phi` (V), without the matrix: face_gradients().
  Eigen::Matrix3Xd gradients(const Eigen::VectorXd& phi) const {
    return face_gradients(mesh(), phi, options_, context_);
  }
  /// Div V d, V, of `vectors` (3 × F), without the matrices: integrated_divergence().
  Eigen::VectorXd divergences(const Eigen::Matrix3Xd& vectors) const {
    return integrated_divergence(mesh(), vectors, options_, context_);
  }

 private:
  GatheredMesh mesh_;
  CalculusOptions options_;
  Context context_;
};

}  // namespace dsc
