#include "libdsc/io/om_chunks.h"

#include "libdsc/base/error.h"
#include "libdsc/io/input_file.h"

#include <cstring>
#include <set>
#include <utility>

namespace dsc::detail {
namespace {

/// Reads front to back, never beyond the end.
class Cursor {
 public:
  explicit Cursor(const OmBytes& file) : file_(file) {}

  Index at() const { return at_; }
  Index remaining() const { return file_.size() - at_; }
  void skip(Index bytes) {
    if (bytes > remaining()) {
      file_.fail(file_.size(), "the file ends here, " + std::to_string(bytes - remaining()) +
                                   " bytes short; it is truncated");
    }
    at_ += bytes;
  }
  template <class T>
  T read() {
    const Index from = at_;
    skip(static_cast<Index>(sizeof(T)));
    T value;
    std::memcpy(&value, file_.bytes.data() + from, sizeof value);
    return value;
  }
  std::string text() {
    const Index length = read<std::uint8_t>();
    skip(length);
    return std::string(file_.bytes.substr(static_cast<std::size_t>(at_ - length),
                                          static_cast<std::size_t>(length)));
  }

 private:
  const OmBytes& file_;
  Index at_ = 0;
};

constexpr int version(int major, int minor) { return major << 5 | minor; }

int read_header(Cursor& cursor, const OmBytes& file, OmFile& om) {
  if (file.bytes.substr(0, 2) != "OM") file.fail(0, "the magic bytes OM are missing");
  cursor.skip(3);
  const int found = cursor.read<std::uint8_t>();
  if (found < version(2, 0) || found > version(2, 2)) {
    file.fail(3, "version " + std::to_string(found >> 5) + "." + std::to_string(found & 31) +
                     " of the format is not read; save the mesh by OpenMesh 9, or as .ply");
  }
  om.vertices = cursor.read<std::uint32_t>();
  om.faces = cursor.read<std::uint32_t>();
  om.edges = cursor.read<std::uint32_t>();
  return found;
}

Index elements(const OmFile& om, OmEntity entity) {
  switch (entity) {
    case OmEntity::vertex:
      return om.vertices;
    case OmEntity::mesh:
      return 1;
    case OmEntity::face:
      return om.faces;
    case OmEntity::edge:
      return om.edges;
    case OmEntity::halfedge:
      return 2 * om.edges;
    case OmEntity::sentinel:
      return 0;
  }
  return -1;
}

/// The chunk's bit fields, its name and its size; `cursor` then stands after its values.
OmChunk read_chunk(Cursor& cursor, const OmBytes& file, const OmFile& om, int file_version) {
  OmChunk chunk;
  chunk.begin = cursor.at();
  const unsigned bits = cursor.read<std::uint16_t>();
  chunk.entity = static_cast<OmEntity>(bits >> 2 & 7);
  chunk.kind = static_cast<OmKind>(bits >> 5 & 15);
  if (chunk.entity == OmEntity::sentinel) return chunk;
  const bool real = (bits >> 10 & 1) != 0;
  const Index dimensions = (bits >> 11 & 7) + 1;
  const Index scale = Index{1} << (bits >> 14 & 3);
  if ((bits >> 1 & 1) != 0) {
    // OpenMesh would read less than what a property has here, and the rest as the next chunk.
    if (chunk.kind != OmKind::custom) {
      file.fail(chunk.begin, "a chunk has a name and is no property; the file is damaged");
    }
    chunk.name = cursor.text();
    if (file_version >= version(2, 2)) chunk.type = cursor.text();
  }
  const Index count = elements(om, chunk.entity);
  if (count < 0) file.fail(chunk.begin, "a chunk of an unknown kind; the file is damaged");
  Index numbers = count * dimensions;
  switch (chunk.kind) {
    case OmKind::custom: {
      const Index bytes = cursor.read<std::uint32_t>();
      chunk.data = cursor.at();
      cursor.skip(bytes);
      chunk.end = cursor.at();
      return chunk;
    }
    case OmKind::topology:
      chunk.value_bytes = scale;
      numbers = chunk.entity == OmEntity::halfedge ? 3 * count : count;
      break;
    case OmKind::status:
      chunk.value_bytes = 4;
      numbers = count;
      break;
    case OmKind::position:
      if (!real || dimensions != 3 || scale > 2) {
        file.fail(chunk.begin, "positions are 3 floats or doubles each; the file is damaged");
      }
      chunk.value_bytes = 4 * scale;
      break;
    case OmKind::normal:
    case OmKind::texture:
    case OmKind::colour:
      chunk.value_bytes = real ? 4 * scale : scale;
      break;
    default:
      file.fail(chunk.begin, "a chunk of an unknown kind; the file is damaged");
  }
  chunk.data = cursor.at();
  cursor.skip(numbers * chunk.value_bytes);  // counts of 32 bits: no overflow
  chunk.end = cursor.at();
  return chunk;
}

Index integer_at(const OmBytes& file, Index at, Index bytes) {
  const char* from = file.bytes.data() + at;
  if (bytes == 1) return static_cast<std::int8_t>(*from);
  if (bytes == 2) {
    std::int16_t value = 0;
    std::memcpy(&value, from, sizeof value);
    return value;
  }
  std::int32_t value = 0;
  std::memcpy(&value, from, sizeof value);
  return value;
}

/// OpenMesh follows the numbers of halfedges, vertices and faces wherever they lead.
void check_topology(const OmBytes& file, const OmFile& om, const OmChunk& chunk) {
  if (chunk.value_bytes > 4) file.fail(chunk.begin, "connectivity of 64 bits is not read");
  const Index halfedges = 2 * om.edges;
  const Index per = chunk.entity == OmEntity::halfedge ? 3 : 1;
  const Index count = elements(om, chunk.entity);
  for (Index i = 0; i < per * count; ++i) {
    const Index at = chunk.data + i * chunk.value_bytes;
    const Index value = integer_at(file, at, chunk.value_bytes);
    Index least = 0, beyond = halfedges;
    if (chunk.entity == OmEntity::vertex) least = -1;  // a vertex of no face
    if (per == 3 && i % 3 == 1) beyond = om.vertices;
    if (per == 3 && i % 3 == 2) {
      least = -1;  // the outside
      beyond = om.faces;
    }
    if (value < least || value >= beyond) {
      file.fail(at, "the connectivity leads to element " + std::to_string(value) + " of " +
                        std::to_string(beyond) + "; the file is damaged");
    }
  }
}

}  // namespace

void OmBytes::fail(Index at, const std::string& why) const {
  throw InputError("'" + path + "', byte " + std::to_string(at) + ": " + printable(why));
}

OmFile find_om_chunks(const OmBytes& file) {
  Cursor cursor(file);
  OmFile om;
  const int file_version = read_header(cursor, file, om);
  bool found[5] = {};
  std::set<std::pair<OmEntity, std::string>> names;  // of custom properties
  for (;;) {
    OmChunk chunk = read_chunk(cursor, file, om, file_version);
    if (chunk.entity == OmEntity::sentinel) break;
    const bool position = chunk.kind == OmKind::position && chunk.entity == OmEntity::vertex;
    if (position || chunk.kind == OmKind::topology) {
      const int which = position                             ? 0
                        : chunk.entity == OmEntity::vertex   ? 1
                        : chunk.entity == OmEntity::halfedge ? 2
                        : chunk.entity == OmEntity::face     ? 3
                                                             : 4;
      if (found[which]) file.fail(chunk.begin, "a chunk comes twice; the file is damaged");
      if (which == 4) file.fail(chunk.begin, "connectivity of edges; the file is damaged");
      found[which] = true;
      if (chunk.kind == OmKind::topology) check_topology(file, om, chunk);
    }
    // OpenMesh would read the second into the first, whatever their types are.
    if (chunk.kind == OmKind::custom && !names.insert({chunk.entity, chunk.name}).second) {
      file.fail(chunk.begin, "the property '" + chunk.name + "' comes twice; the file is damaged");
    }
    om.chunks.push_back(std::move(chunk));
  }
  if (cursor.remaining() > 0) file.fail(cursor.at(), "the file goes on after its last chunk");
  const bool none = om.vertices == 0 && om.faces == 0 && om.edges == 0;
  if (!none && !(found[0] && found[1] && found[2] && found[3])) {
    file.fail(cursor.at(), "positions or connectivity are missing; the file is damaged");
  }
  return om;
}

}  // namespace dsc::detail
