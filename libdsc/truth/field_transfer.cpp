#include "libdsc/truth/field_transfer.h"

#include "libdsc/base/error.h"
#include "libdsc/base/parallel.h"

#include <string>
#include <vector>

namespace dsc::truth {

Eigen::MatrixXd FieldTransfer::of_faces(const Eigen::Ref<const Eigen::MatrixXd>& field) const {
  Eigen::MatrixXd result(static_cast<Index>(faces.size()), field.cols());
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (faces[i] >= field.rows()) {
      throw UsageError("field transfer: the field has " + std::to_string(field.rows()) +
                       " rows, too few for face " + std::to_string(faces[i]));
    }
    result.row(static_cast<Index>(i)) = field.row(faces[i]);
  }
  return result;
}

FieldTransfer field_transfer(const FlatMesh& surface, Vec3View positions, Vec3View points,
                             const Context& context) {
  if (positions.empty()) positions = surface.positions;
  if (positions.size != surface.vertices()) {
    throw UsageError("field transfer: " + std::to_string(positions.size) + " positions for " +
                     std::to_string(surface.vertices()) + " vertices");
  }
  TriangleMesh triangles;
  triangles.vertices = positions.matrix();
  std::vector<Index> face_of;
  for (Index f = 0; f < surface.faces(); ++f) {
    const auto corners = surface.face(f);
    for (std::size_t k = 2; k < corners.size(); ++k) {
      triangles.faces.push_back({corners[0], corners[k - 1], corners[k]});
      face_of.push_back(f);
    }
  }
  const MeshTree tree(triangles);
  std::vector<MeshPoint> closest(static_cast<std::size_t>(points.size));
  parallel_for(context, points.size, 1024, [&](Index first, Index last) {
    for (Index i = first; i < last; ++i) {
      closest[static_cast<std::size_t>(i)] = tree.closest(points[i]);
    }
  });

  FieldTransfer transfer;
  std::vector<Eigen::Triplet<double>> weights;
  for (Index i = 0; i < points.size; ++i) {
    const MeshPoint& at = closest[static_cast<std::size_t>(i)];
    transfer.faces.push_back(face_of[static_cast<std::size_t>(at.face)]);
    const Triangle& corners = triangles.faces[static_cast<std::size_t>(at.face)];
    for (int k = 0; k < 3; ++k) {
      if (at.barycentric[k] > 0) {
        weights.emplace_back(static_cast<int>(i), corners[static_cast<std::size_t>(k)],
                             at.barycentric[k]);
      }
    }
  }
  transfer.vertex_weights.resize(points.size, surface.vertices());
  transfer.vertex_weights.setFromTriplets(weights.begin(), weights.end());
  return transfer;
}

}  // namespace dsc::truth
