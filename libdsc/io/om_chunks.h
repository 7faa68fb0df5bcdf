/// \file
/// \internal
/// The chunks of an .om file, OpenMesh's own format, found and checked before OpenMesh reads them.
///
/// A file is a header of 16 bytes (OM, the kind of mesh, a version, the numbers of vertices, faces
/// and edges), then chunks: two bytes of bit fields, for custom properties their name, type and
/// size, then values. The last chunk is a sentinel. Little-endian.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/base/types.h"
#include "libdsc/io/polygon_mesh.h"

#include <string>
#include <string_view>
#include <vector>

namespace dsc::detail {

enum class OmEntity { vertex = 0, mesh = 1, face = 2, edge = 4, halfedge = 6, sentinel = 7 };
enum class OmKind { position = 0, normal, texture, status, colour, custom = 6, topology = 7 };

struct OmChunk {
  OmEntity entity = OmEntity::sentinel;
  OmKind kind = OmKind::position;
  std::string name, type;    ///< of a custom property; the type where the version tells it
  Index begin = 0, end = 0;  ///< bytes of the file, its header included
  Index data = 0;            ///< byte of the first value
  Index value_bytes = 0;     ///< of one number; 0 for custom properties
};

struct OmFile {
  Index vertices = 0, faces = 0, edges = 0;
  std::vector<OmChunk> chunks;  ///< without the sentinel
};

/// The whole file, and its name for messages.
struct OmBytes {
  std::string_view bytes;
  std::string path;

  Index size() const { return static_cast<Index>(bytes.size()); }
  /// \throws InputError "PATH, byte AT: why".
  [[noreturn]] void fail(Index at, const std::string& why) const;
};

/// Finds the chunks, and checks that connectivity stays within the mesh. \throws InputError.
OmFile find_om_chunks(const OmBytes& file);

/// The mesh, read by OpenMesh. \throws InputError.
PolygonMesh parse_om(const OmBytes& file, const Context& context = {});

}  // namespace dsc::detail
