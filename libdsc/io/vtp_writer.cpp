// ParaView's XML PolyData. The arrays follow the markup as one block of base64 each, so that the
// file is well-formed XML; a block is a 64-bit byte count and the data, encoded as one stream.
#include "libdsc/io/atomic_file.h"
#include "libdsc/io/base64.h"
#include "libdsc/io/result_writers.h"

#include <fmt/format.h>

#include <limits>

namespace dsc::detail {
namespace {

/// One array of the file: what the markup says about it and how its elements become bytes.
struct Block {
  std::string markup;  ///< the attributes but for the offset
  Index elements = 0;
  Index element_bytes = 0;
  Encode encode;

  Index bytes() const { return elements * element_bytes; }
  Index base64_bytes() const { return (bytes() + 8 + 2) / 3 * 4; }
};

/// An array of parts.size() components; several are named, as ParaView shows them.
Block doubles(const std::string& name, const std::vector<std::string>& parts,
              std::span<const double> values) {
  Block block;
  block.markup = "type=\"Float64\" Name=\"" + name + "\" NumberOfComponents=\"" +
                 std::to_string(parts.size()) + "\"";
  for (std::size_t i = 0; parts.size() > 1 && i < parts.size(); ++i) {
    block.markup += " ComponentName" + std::to_string(i) + "=\"" + parts[i] + "\"";
  }
  block.elements = static_cast<Index>(values.size());
  block.element_bytes = sizeof(double);
  block.encode = [values](Index first, Index last, std::string& out) {
    out.append(reinterpret_cast<const char*>(values.data() + first),
               static_cast<std::size_t>(last - first) * sizeof(double));
  };
  return block;
}

/// Integers in 32 bits where all of them fit, which halves the file.
template <class ValueAt>
Block integers(const std::string& name, bool narrow, Index n, ValueAt&& value_at) {
  Block block;
  block.markup = fmt::format("type=\"{}\" Name=\"{}\"", narrow ? "Int32" : "Int64", name);
  block.elements = n;
  block.element_bytes = narrow ? 4 : 8;
  block.encode = [narrow, value_at](Index first, Index last, std::string& out) {
    for (Index i = first; i < last; ++i) {
      if (narrow) {
        append_bytes(out, static_cast<std::int32_t>(value_at(i)));
      } else {
        append_bytes(out, static_cast<std::int64_t>(value_at(i)));
      }
    }
  };
  return block;
}

/// The count and the data are one stream: its first chunk takes one element and the count, which
/// is a multiple of 3 bytes for elements of 4 and 8 bytes alike (8 + 4, 8 + 2 x 8, …).
void write_block(AtomicFile& file, const Block& block, const Context& context) {
  constexpr Index kGrain = 3 << 12;  // a multiple of 3 elements
  const Index head = block.element_bytes == 4 ? 1 : 2;
  std::string raw, text;
  append_bytes(raw, static_cast<std::uint64_t>(block.bytes()));
  block.encode(0, std::min(head, block.elements), raw);
  append_base64(text, raw);
  file.write(text.data(), text.size());
  const auto encode = [&](Index first, Index last, std::string& out) {
    std::string bytes;
    bytes.reserve(static_cast<std::size_t>((last - first) * block.element_bytes));
    block.encode(head + first, head + last, bytes);
    append_base64(out, bytes);
  };
  if (block.elements > head) write_in_chunks(file, block.elements - head, kGrain, encode, context);
}

}  // namespace

void write_vtp(AtomicFile& file, const Result& result, const Context& context) {
  const FlatMesh& mesh = result.mesh;
  const bool narrow = mesh.corner_count() <= std::numeric_limits<std::int32_t>::max();
  std::vector<Block> blocks;
  std::string xml;
  Index offset = 0;
  const auto add = [&](Block block) {
    xml += "        <DataArray " + block.markup + " format=\"appended\" offset=\"" +
           std::to_string(offset) + "\"/>\n";
    offset += block.base64_bytes();
    blocks.push_back(std::move(block));
  };
  const auto add_fields = [&](FieldOn on) {
    for (const Field& field : result.fields) {
      if (field.on == on) add(doubles(field.name, field.parts, field.values));
    }
  };

  xml += "<?xml version=\"1.0\"?>\n";
  xml +=
      "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n";
  xml += "  <PolyData>\n    <Piece NumberOfPoints=\"" + std::to_string(mesh.vertices()) +
         "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"" +
         std::to_string(mesh.faces()) + "\">\n";
  xml += "      <PointData>\n";
  add_fields(FieldOn::vertex);
  xml += "      </PointData>\n      <CellData>\n";
  add_fields(FieldOn::face);
  xml += "      </CellData>\n      <Points>\n";
  add(doubles("Points", {"x", "y", "z"},
              {mesh.positions.data, static_cast<std::size_t>(3 * mesh.vertices())}));
  xml += "      </Points>\n      <Polys>\n";
  add(integers("connectivity", narrow, mesh.corner_count(),
               [&](Index c) { return mesh.corners[static_cast<std::size_t>(c)]; }));
  add(integers("offsets", narrow, mesh.faces(), [&](Index f) { return mesh.first_corner(f + 1); }));
  xml += "      </Polys>\n    </Piece>\n  </PolyData>\n  <AppendedData encoding=\"base64\">\n_";
  file.write(xml.data(), xml.size());
  for (const Block& block : blocks) write_block(file, block, context);
  const std::string tail = "\n  </AppendedData>\n</VTKFile>\n";
  file.write(tail.data(), tail.size());
}

}  // namespace dsc::detail
