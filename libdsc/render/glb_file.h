/// \file
/// A result as .glb (glTF 2.0, binary), for viewers and game engines: the surface with vertex
/// colours.
///
/// Kept: triangles (a quad is cut along its shorter diagonal, a larger face into a fan), positions
/// as floats about the middle of the box (which is the node's translation, in doubles), shared
/// vertices, the colours of the first scalar field, and each vertex scalar as floats, an attribute
/// `_NAME`. Where that first scalar is on faces, or there is no scalar, each face has vertices and
/// a normal of its own.
#pragma once

#include "libdsc/io/results.h"

#include <string>
#include <vector>

namespace dsc::render {

/// Whether `path` ends in .glb, upper or lower case, or is `glb:-`, standard output.
bool is_glb_path(const std::string& path);

/// Writes `result`; values of both signs are coloured by `polar`, others by `lagoon`, infinite ones
/// grey. Vertices are shaded by the mean of the normals of the mesh around them, where it has some.
/// \return the names of the fields that are neither shown nor kept: vectors, further scalars of
/// faces, scalars with an infinite value (which glTF does not allow).
/// \throws InputError on an empty mesh, positions that are not finite or beyond floats, and NaN;
/// LimitError beyond 4 GiB; OutputError. The file at `path` is then as it was.
std::vector<std::string> write_glb(const std::string& path, const Result& result,
                                   const Context& context = {});

}  // namespace dsc::render
