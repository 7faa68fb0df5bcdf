/// \file
/// A polygon mesh and the fields on it, as a file holds them.
#pragma once

#include "libdsc/calculus/mesh_calculus.h"
#include "libdsc/io/results.h"

#include <string>
#include <vector>

namespace dsc {

/// A Field that owns its values.
struct MeshField {
  std::string name;                ///< as in Field
  std::vector<std::string> parts;  ///< their names; one for a scalar
  FieldOn on = FieldOn::vertex;    ///< what has a value each
  std::vector<double> values;      ///< one after another, parts.size() each
};

/// Positions, corners, offsets and estimated face normals (see GatheredMesh; `offsets` is never
/// empty here), and the fields beside them. Faces need not form a manifold: they share a vertex
/// exactly where they name the same one.
struct PolygonMesh : GatheredMesh {
  std::vector<MeshField> fields;  ///< all but `normals`
  /// What the file held that is not here, and what was changed on the way in; a sentence each.
  std::vector<std::string> remarks;

  /// What write_result() writes: the mesh, `normals` as the face field normal (nx, ny, nz), the
  /// fields. A view, as Result is.
  Result result() const;
};

}  // namespace dsc
