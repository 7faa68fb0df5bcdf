#include "libdsc/calculus/mesh_checks.h"

#include "libdsc/base/checked.h"

#include <cmath>
#include <sstream>

namespace dsc {

void check_mesh(const FlatMesh& mesh, const CalculusOptions& options) {
  const Index corners = mesh.corner_count();
  checked_id(corners, "face corners");
  checked_id(mesh.vertices(), "vertices");
  if (mesh.offsets.empty()) {
    if (corners % 4 != 0) {
      throw InputError(std::to_string(corners) +
                       " corners are no whole number of quads; give corner offsets");
    }
  } else {
    if (mesh.offsets.front() != 0 || mesh.offsets.back() != corners) {
      throw InputError("the corner offsets must run from 0 to the number of corners, " +
                       std::to_string(corners));
    }
    for (Index f = 0; f < mesh.faces(); ++f) {
      const Index n = mesh.first_corner(f + 1) - mesh.first_corner(f);
      if (n < 3) {
        throw InputError("face " + std::to_string(f) + " has " + std::to_string(n) +
                         " corners; it needs at least 3");
      }
    }
  }
  const Index faces = mesh.faces();
  if (mesh.has_normals() && mesh.normals.size != faces) {
    throw InputError(std::to_string(mesh.normals.size) + " normals for " + std::to_string(faces) +
                     " faces");
  }
  if (mesh.is_digital()) {
    if (static_cast<Index>(mesh.surfels.size()) != faces || !mesh.offsets.empty()) {
      throw InputError(std::to_string(mesh.surfels.size()) + " surfels for " +
                       std::to_string(faces) +
                       " faces; every face of a digital surface is a quad with its surfel");
    }
    for (int k = 0; k < 3; ++k) {
      if (!std::isfinite(mesh.spacing[k]) || mesh.spacing[k] <= 0.) {
        throw InputError("the voxel spacing must be positive on every axis");
      }
      // Areas and their inverse, and ratios of sides, as the operators have them.
      const double side = mesh.spacing[k], next = mesh.spacing[(k + 1) % 3], area = side * next;
      if (!std::isnormal(area) || !std::isnormal(1 / area) || !std::isnormal(side / next)) {
        std::ostringstream text;
        text << "surfels of " << side << " x " << next
             << " have no area, or sides too different, for doubles; choose another unit of length";
        throw InputError(text.str());
      }
    }
  } else if (options.stabilization == Stabilization::corrected_elements ||
             options.stabilization == Stabilization::virtual_refinement) {
    throw UsageError(
        "this stabilization is made for surfels; on general polygons choose de_goes or mercat");
  }
}

std::string face_name(const FlatMesh& mesh, Index face) {
  std::ostringstream name;
  name << "face " << face;
  Vec3 mean = Vec3::Zero();
  for (const VertexId v : mesh.face(face)) {
    if (v < 0 || v >= mesh.vertices()) return name.str();
    mean += mesh.positions[v];
  }
  mean /= static_cast<double>(mesh.face(face).size());
  name << " (near " << mean.x() << ", " << mean.y() << ", " << mean.z() << ")";
  return name.str();
}

void refuse_normal(const FlatMesh& mesh, Index face) {
  throw InputError(
      face_name(mesh, face) +
      ": the estimated normal is not a unit vector; estimate it again or normalise it");
}

void refuse_vertex(const FlatMesh& mesh, Index face, VertexId v) {
  throw InputError(face_name(mesh, face) + ": corner " + std::to_string(v) + " is not one of the " +
                   std::to_string(mesh.vertices()) + " vertices");
}

void refuse_area(const FlatMesh& mesh, Index face) {
  throw InputError(
      face_name(mesh, face) +
      ": no area: its corners coincide, lie on a line or are not finite; remove the face");
}

void refuse_direction(const FlatMesh& mesh, Index face) {
  throw InputError(face_name(mesh, face) + ": its surfel has no direction in 0 to 5");
}

}  // namespace dsc
