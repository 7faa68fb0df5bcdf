/// \file
/// The calculus on any OpenMesh polygon or triangle mesh: any traits, float or double, faces of any
/// size, planar or not.
///
///     const dsc::MeshCalculus calculus = dsc::calculus_on_mesh(mesh);
///     const dsc::SparseMatrix L = calculus.laplacian();
///
/// Two face properties steer it. The corner table (`dsc:corners`; std::array<int, n> or
/// std::vector<int>) lists each face's vertex ids in face order, where the mesh has more vertices
/// than degrees of freedom; id v has the position of mesh vertex v. The normal property
/// (`dsc:normal`; a 3-vector of float or double) holds the estimated unit normals. Without a table
/// the ids are the mesh's own vertices, without normals the calculus is the naive one.
///
/// This template only gathers; everything behind it is compiled once.
#pragma once

#include "libdsc/base/checked.h"
#include "libdsc/base/error.h"
#include "libdsc/calculus/mesh_calculus.h"

#include <OpenMesh/Core/Geometry/VectorT.hh>
#include <OpenMesh/Core/Mesh/Handles.hh>
#include <OpenMesh/Core/Utils/Property.hh>
#include <OpenMesh/Core/Utils/vector_traits.hh>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <type_traits>

namespace dsc {

/// Names of the face properties to read. Unset: the name in the comment, where the mesh has it. A
/// name: that property, which must be there. An empty name: none.
struct MeshProperties {
  std::optional<std::string> corners;  ///< "dsc:corners"
  std::optional<std::string> normals;  ///< "dsc:normal"
};

namespace detail {

/// Calls use(property) with the face property `name` of the first of the types T that it has.
template <class... T, class Mesh, class Use>
bool with_face_property(const Mesh& mesh, const std::optional<std::string>& name, const char* usual,
                        const char* what, Use&& use) {
  const std::string wanted = name.value_or(usual);
  if (wanted.empty()) return false;
  const auto attempt = [&](auto handle) {
    if (!mesh.get_property_handle(handle, wanted)) return false;
    use([&mesh,
         handle ](OpenMesh::FaceHandle f) -> const auto& { return mesh.property(handle, f); });
    return true;
  };
  const bool found = (attempt(OpenMesh::FPropHandleT<T>()) || ...);
  if (!found && name) {
    throw UsageError("the mesh has no face property '" + wanted + "' of a type that serves as " +
                     what);
  }
  return found;
}

inline std::string mesh_face(Index f) { return "face " + std::to_string(f) + " of the mesh"; }

template <class Mesh>
void refuse_deleted(const Mesh& mesh) {
  bool deleted = false;
  if (mesh.has_face_status()) {
    for (int f = 0; f < static_cast<int>(mesh.n_faces()); ++f) {
      deleted = deleted || mesh.status(OpenMesh::FaceHandle(f)).deleted();
    }
  }
  if (mesh.has_vertex_status()) {
    for (int v = 0; v < static_cast<int>(mesh.n_vertices()); ++v) {
      deleted = deleted || mesh.status(OpenMesh::VertexHandle(v)).deleted();
    }
  }
  if (deleted) throw UsageError("the mesh has deleted elements; call garbage_collection() first");
}

/// A stored normal in double. One that was rounded to float is made a unit vector again.
template <class Vector>
Vec3 unit_normal(const Vector& stored, Index f) {
  Vec3 u(stored[0], stored[1], stored[2]);
  const double length = u.norm();
  if (!(std::abs(length - 1.) < 1e-3)) {
    throw InputError(mesh_face(f) + ": its normal is not a unit vector");
  }
  if (!std::is_same_v<std::decay_t<decltype(stored[0])>, double>) u /= length;
  return u;
}

}  // namespace detail

/// The mesh as flat arrays.
/// \throws UsageError where a property asked for by name is absent or of another type, or where the
/// mesh has deleted elements; InputError where the corner table does not fit the mesh or a normal
/// is not a unit vector.
template <class Mesh>
GatheredMesh gather(const Mesh& mesh, const MeshProperties& properties = {}) {
  using Point = typename Mesh::Point;
  using Normal = typename Mesh::Normal;
  static_assert(OpenMesh::vector_traits<Point>::size_ == 3, "the calculus lives in space");
  detail::refuse_deleted(mesh);
  const auto F = static_cast<Index>(mesh.n_faces());
  const auto mesh_vertices = static_cast<Index>(mesh.n_vertices());
  GatheredMesh result;
  result.offsets.push_back(0);

  Index vertices = mesh_vertices;
  const bool table = detail::with_face_property<std::array<VertexId, 4>, std::vector<VertexId>,
                                                std::array<VertexId, 3>>(
      mesh, properties.corners, "dsc:corners", "a corner table", [&](auto&& corners_of) {
        VertexId greatest = -1;
        for (Index f = 0; f < F; ++f) {
          const OpenMesh::FaceHandle face(static_cast<int>(f));
          const auto& ids = corners_of(face);
          if (ids.size() != mesh.valence(face)) {
            throw InputError(detail::mesh_face(f) + ": the corner table has " +
                             std::to_string(ids.size()) + " entries for " +
                             std::to_string(mesh.valence(face)) + " corners");
          }
          for (const VertexId v : ids) {
            if (v < 0 || v >= mesh_vertices) {
              throw InputError(detail::mesh_face(f) + ": corner " + std::to_string(v) +
                               " of its table is not one of the " + std::to_string(mesh_vertices) +
                               " vertices");
            }
            greatest = std::max(greatest, v);
            result.corners.push_back(v);
          }
          result.offsets.push_back(static_cast<Index>(result.corners.size()));
        }
        vertices = Index{greatest} + 1;
      });
  if (!table) {
    for (Index f = 0; f < F; ++f) {
      const OpenMesh::FaceHandle face(static_cast<int>(f));
      for (auto v = mesh.cfv_iter(face); v.is_valid(); ++v) result.corners.push_back((*v).idx());
      result.offsets.push_back(static_cast<Index>(result.corners.size()));
    }
  }

  result.positions.resize(3, vertices);
  for (Index v = 0; v < vertices; ++v) {
    const Point& p = mesh.point(OpenMesh::VertexHandle(static_cast<int>(v)));
    result.positions.col(v) = Vec3(p[0], p[1], p[2]);
  }

  const auto read_normals = [&](auto&& normal_of) {
    result.normals.resize(3, F);
    for (Index f = 0; f < F; ++f) {
      result.normals.col(f) =
          detail::unit_normal(normal_of(OpenMesh::FaceHandle(static_cast<int>(f))), f);
    }
  };
  detail::with_face_property<OpenMesh::Vec3d, OpenMesh::Vec3f, Normal, Vec3>(
      mesh, properties.normals, "dsc:normal", "normals", read_normals);
  return result;
}

/// The calculus on the mesh as it is now; a copy is taken. Errors as gather().
template <class Mesh>
MeshCalculus calculus_on_mesh(const Mesh& mesh, const MeshProperties& properties = {},
                              const CalculusOptions& options = {}, const Context& context = {}) {
  return MeshCalculus(gather(mesh, properties), options, context);
}

}  // namespace dsc
