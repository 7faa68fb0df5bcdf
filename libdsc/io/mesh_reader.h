/// \file
/// Polygon meshes from files: .off, .obj, .ply, .stl, .om.
///
/// Coordinates are read in double precision, faces keep all their corners. What a file holds
/// beside is kept where it says so here, else it is counted in PolygonMesh::remarks.
///
/// - `.off`: text; OFF, and COFF, NOFF, STOFF and their joins; a vertex and a face a line. Vertex
///   normals become the field normal; colours and texture coordinates are left out.
/// - `.obj`: v and f (v, v/t, v//n, v/t/n, counted from 1 or back from the last); texture
///   coordinates, normals, groups, materials, lines and points are left out; curves and surfaces
///   are refused.
/// - `.ply`: text or binary in either byte order; elements vertex and face; every scalar property
///   becomes a field; three of one name but for x, y, z at its end become a vector. Other elements
///   and other lists are left out.
/// - `.stl`: text or binary. The format repeats each vertex in each triangle: corners of equal
///   coordinates (-0 is 0) become one vertex. Facet normals and attributes are left out.
/// - `.om`: through OpenMesh, whose format it is (versions 2.0 to 2.2, little-endian), after a
/// check
///   of its own: OpenMesh trusts what it reads. Properties of scalars and 3-vectors are kept; the
///   vertex property `dsc:vertex` glues what a halfedge mesh had to split.
///
/// The face field normal (nx, ny, nz in .ply, `dsc:normal` in .om) becomes PolygonMesh::normals
/// where all its vectors have length 1 within 0.001; those that a file held as floats are
/// normalised. Else it stays a field, with a remark. A field that holds NaN is left out.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/io/polygon_mesh.h"

#include <string>

namespace dsc {

/// The endings that read_mesh() knows: ".off, .obj, .ply, .stl, .om".
std::string mesh_endings();

/// Whether the ending of `path` is one of them, in upper or lower case.
bool is_mesh_path(const std::string& path);

/// Reads the mesh of a file. Memory is bounded by a small multiple of the file's size, whatever
/// sizes its header promises. A text file may end without a newline; a number on which it ends is
/// then taken as whole, which a remark says, as it may have been cut off. Only an .obj file that
/// libdsc wrote is known to end in one and is refused. An .obj file of others says nowhere how much
/// it holds, and text .stl nowhere how many solids: cut after a line, or after a solid, it is a
/// whole file. Every other cut is an error.
/// \throws UsageError where the ending is unknown; InputError naming the file, the line or byte,
/// and the remedy where the file cannot be read, is truncated, goes on after its end, contradicts
/// itself, has a coordinate that is not finite, a face of fewer than 3 corners, or a corner that is
/// no vertex; LimitError where 31-bit ids cannot number what it holds; Cancelled.
PolygonMesh read_mesh(const std::string& path, const Context& context = {});

}  // namespace dsc
