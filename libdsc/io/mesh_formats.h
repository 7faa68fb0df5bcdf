/// \file
/// \internal
/// The reader of each mesh format, and what they share. Private: call read_mesh().
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/io/input_file.h"
#include "libdsc/io/polygon_mesh.h"

#include <string>
#include <string_view>
#include <vector>

namespace dsc::detail {

PolygonMesh read_off(InputFile& file, const Context& context);
PolygonMesh read_obj(InputFile& file, const Context& context);
PolygonMesh read_ply(InputFile& file, const Context& context);
PolygonMesh read_stl(InputFile& file, const Context& context);
PolygonMesh read_om(InputFile& file, const Context& context);

/// What read_mesh() does with the file of that name.
PolygonMesh read_mesh(InputFile& file, const Context& context);

/// The name and the three parts of a vector whose parts end in x, y, z, or an empty name. Parts
/// {nx, ny, nz} are of `normal`, {gx, gy, gz} of `gradient`, {d_x, d_y, d_z} of `d`.
std::string vector_name(std::string_view a, std::string_view b, std::string_view c);

/// The opposite of vector_name().
std::vector<std::string> vector_parts(const std::string& name);

/// Packed coordinates as columns.
Eigen::Matrix3Xd columns_of(const std::vector<double>& xyz);

/// What the offsets and corners of faces take while they grow, most of them triangles or quads.
inline Index faces_bytes(Index faces) { return (8 + 36) * faces; }

/// Asks for memory before `values` grow to twice their size.
template <class T>
void need_room(const std::vector<T>& values, const Context& context) {
  if (values.size() < values.capacity()) return;
  context.need("read", 2 * static_cast<Index>(values.size() * sizeof(T)));
}

/// The same for corners of faces that have more than faces_bytes() is made for.
inline void need_corners(const PolygonMesh& mesh, const Context& context) {
  if (std::ssize(mesh.corners) > 4 * std::ssize(mesh.offsets)) need_room(mesh.corners, context);
}

/// "1 face", "2 faces".
std::string counted(Index n, const std::string& singular, const std::string& plural);

}  // namespace dsc::detail
