/// \file
/// The OpenMesh mesh that stores a digital surface, and the names of its properties.
#pragma once

#include "libdsc/base/types.h"
#include "libdsc/surface/surfel.h"

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>

#include <array>

namespace dsc {

/// Double positions, no per-element attributes beyond the connectivity (prev included).
struct SurfaceTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;   ///< double, not float
  using Normal = OpenMesh::Vec3d;  ///< the same
};

/// The mesh of DigitalSurface, and what split_mesh() fills.
using SurfaceMesh = OpenMesh::PolyMesh_ArrayKernelT<SurfaceTraits>;

/// The vertex ids of a quad's corners, in the face's own order (kSurfelFrames).
using QuadCorners = std::array<VertexId, 4>;

/// Property names, for OpenMesh programs that look them up.
namespace property {
inline constexpr const char* kCorners = "dsc:corners";  ///< face: QuadCorners, the side table
inline constexpr const char* kSurfel = "dsc:surfel";    ///< face: Surfel
inline constexpr const char* kLabels = "dsc:labels";    ///< face: LabelPair, of label volumes
inline constexpr const char* kNormal = "dsc:normal";    ///< face: OpenMesh::Vec3d, u, outwards
inline constexpr const char* kVertexId =
    "dsc:vertex";  ///< vertex: VertexId, its id in the side table
}  // namespace property

}  // namespace dsc
