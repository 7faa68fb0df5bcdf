/// \file
/// Fields of a digital surface, seen on the smooth one: for pictures, and to compare with fields
/// that are known there.
///
/// A value at a pointel stands for the value at its projection, so the surfels are taken with
/// their corners projected onto the smooth surface, each cut into two triangles; a point of the
/// smooth surface takes the values of the closest point of these triangles. Where the pointels'
/// own positions are given instead, functions linear in space are off by their slope times the
/// distance from the surfels, O(h); with projected ones by the same times the height of the
/// triangles, O(h^2).
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/surface/flat_mesh.h"
#include "libdsc/truth/mesh_tree.h"

namespace dsc::truth {

/// Which vertices, with which weights, or which face a point takes its value from.
struct FieldTransfer {
  /// P x V; each row has up to three positive weights of sum 1. On points: vertex_weights * field,
  /// for fields of any number of columns.
  Eigen::SparseMatrix<double, Eigen::RowMajor> vertex_weights;
  std::vector<Index> faces;  ///< P: the face that the closest point is on

  /// Row i is row faces[i] of a field on the faces, F x any.
  Eigen::MatrixXd of_faces(const Eigen::Ref<const Eigen::MatrixXd>& field) const;
};

/// From `surface`, faces of any number of corners (cut into a fan from the first), to `points`.
/// `positions` replaces those of the mesh where it is not empty. \throws UsageError where it has
/// another size, InputError where a position is not finite or no face has an area.
FieldTransfer field_transfer(const FlatMesh& surface, Vec3View positions, Vec3View points,
                             const Context& context = {});

}  // namespace dsc::truth
