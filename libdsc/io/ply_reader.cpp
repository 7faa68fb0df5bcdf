// Stanford's PLY; see mesh_reader.h for what is read.
#include "libdsc/base/checked.h"
#include "libdsc/io/mesh_formats.h"
#include "libdsc/io/ply_values.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

namespace dsc::detail {
namespace {

/// Where a property's values go: every `stride`-th double from `data` on; nowhere where it is null.
struct Column {
  double* data = nullptr;
  Index stride = 1;
};

/// Part k of `stride` in values that begin at `data`, which is null where there are none.
Column column_of(double* data, std::size_t k, std::size_t stride) {
  return {data == nullptr ? nullptr : data + k, static_cast<Index>(stride)};
}

/// A whole number, which may be beyond every integer.
std::string shown(double number) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, number).ptr};
}

class PlyReader {
 public:
  PlyReader(InputFile& file, const Context& context)
      : context_(context),
        lines_(file, [this](Index bytes) { advance(bytes); }),
        header_(read_ply_header(lines_)),
        values_(open_ply_values(header_.encoding, file, lines_,
                                [this](Index bytes) { advance(bytes); })) {
    mesh_.offsets.push_back(0);
  }

  PolygonMesh read() {
    bool vertices = false;
    for (const PlyElement& element : header_.elements) {
      check_room(element);
      if (element.name == "vertex") {
        read_vertices(element);
        vertices = true;
      } else if (element.name == "face") {
        if (!vertices) lines_.fail("the faces come before the vertices; save the file anew");
        read_faces(element);
      } else {
        skip(element);
      }
    }
    if (!vertices) lines_.fail("the header has no element vertex");
    values_->finish();
    lines_.remark_unended_number(mesh_.remarks);
    return std::move(mesh_);
  }

 private:
  void advance(Index bytes) {
    context_.check();
    context_.advance(bytes);
  }

  void check_room(const PlyElement& element) {
    if (element.count <= values_->room_for(element)) return;
    lines_.fail("the header promises " + std::to_string(element.count) + " elements " +
                element.name +
                ", more than the rest of the file can hold; it is truncated or the "
                "header is wrong");
  }

  /// The columns of an element's properties; lists and those in `own` have none.
  std::vector<Column> make_fields(const PlyElement& element, FieldOn on,
                                  const std::array<std::string_view, 3>& own) {
    const auto& all = element.properties;
    const auto is_field = [&](std::size_t i) {
      return i < all.size() && !all[i].count && all[i].name != own[0] && all[i].name != own[1] &&
             all[i].name != own[2];
    };
    std::vector<Column> columns(all.size());
    for (std::size_t i = 0; i < all.size();) {
      if (!is_field(i)) {
        ++i;
        continue;
      }
      MeshField field;
      field.on = on;
      std::size_t parts = 1;
      if (is_field(i + 1) && is_field(i + 2)) {
        field.name = vector_name(all[i].name, all[i + 1].name, all[i + 2].name);
        if (!field.name.empty()) parts = 3;
      }
      if (parts == 1) field.name = all[i].name;
      field.values.resize(static_cast<std::size_t>(element.count) * parts);
      for (std::size_t k = 0; k < parts; ++k, ++i) {
        field.parts.push_back(all[i].name);
        columns[i] = column_of(field.values.data(), k, parts);
      }
      mesh_.fields.push_back(std::move(field));  // its values stay where they are
    }
    return columns;
  }

  void note_lists(const PlyElement& element, std::string_view but) {
    for (const PlyProperty& p : element.properties) {
      if (p.count && p.name != but) {
        mesh_.remarks.push_back("the list " + p.name + " of the element " + element.name +
                                " was left out");
      }
    }
  }

  void skip_value(const PlyProperty& p) {
    if (p.count) {
      values_->skip_list(values_->length(*p.count), p.type);
    } else {
      (void)values_->next(p.type);
    }
  }

  /// Also a bound of the number of vertices: without any property the file could promise any.
  void check_coordinates(const PlyElement& element) const {
    for (const char* axis : {"x", "y", "z"}) {
      const bool found =
          std::any_of(element.properties.begin(), element.properties.end(),
                      [&](const PlyProperty& p) { return !p.count && p.name == axis; });
      if (!found) lines_.fail("the vertices lack x, y or z");
    }
  }

  /// What make_fields() takes, and a little more: the coordinates are no field.
  static Index fields_bytes(const PlyElement& element) {
    return 8 * static_cast<Index>(element.properties.size()) * element.count;
  }

  void read_vertices(const PlyElement& element) {
    check_coordinates(element);  // without a property there is no bound for the count
    checked_id(element.count, "vertices");
    context_.need("read", 24 * element.count + fields_bytes(element));
    mesh_.positions.resize(3, element.count);
    std::vector<Column> columns = make_fields(element, FieldOn::vertex, {"x", "y", "z"});
    constexpr std::array<const char*, 3> kAxes{"x", "y", "z"};
    for (std::size_t i = 0; i < columns.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        const PlyProperty& p = element.properties[i];
        if (p.count || p.name != kAxes[k]) continue;
        columns[i] = column_of(mesh_.positions.data(), k, 3);
      }
    }
    note_lists(element, "");
    for (Index v = 0; v < element.count; ++v) {
      values_->begin(element.name, v);
      for (std::size_t i = 0; i < columns.size(); ++i) {
        const PlyProperty& p = element.properties[i];
        const Column& column = columns[i];
        if (column.data == nullptr) {
          skip_value(p);
          continue;
        }
        const double value = values_->next(p.type);
        column.data[v * column.stride] = value;
      }
      if (!mesh_.positions.col(v).allFinite()) {
        values_->fail("a coordinate is not finite; repair the vertex or remove it");
      }
      values_->end();
    }
  }

  void read_faces(const PlyElement& element) {
    std::size_t corners = element.properties.size();
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const PlyProperty& p = element.properties[i];
      if (p.count && (p.name == "vertex_indices" || p.name == "vertex_index")) corners = i;
    }
    if (corners == element.properties.size()) {
      lines_.fail("the faces lack the list vertex_indices");
    }
    const PlyProperty& list = element.properties[corners];
    if (!is_integer(list.type)) lines_.fail("the corners of faces must be of an integer type");
    context_.need("read", faces_bytes(element.count) + fields_bytes(element));
    const std::vector<Column> columns = make_fields(element, FieldOn::face, {});
    note_lists(element, list.name);
    mesh_.offsets.reserve(static_cast<std::size_t>(element.count) + 1);
    for (Index f = 0; f < element.count; ++f) {
      values_->begin(element.name, f);
      for (std::size_t i = 0; i < columns.size(); ++i) {
        const PlyProperty& p = element.properties[i];
        if (i == corners) {
          read_corners(list);
        } else if (columns[i].data == nullptr) {
          skip_value(p);
        } else {
          columns[i].data[f * columns[i].stride] = values_->next(p.type);
        }
      }
      values_->end();
    }
  }

  void read_corners(const PlyProperty& list) {
    const Index n = values_->length(*list.count);
    if (n < 3) values_->fail("a face has " + counted(n, "corner", "corners") + "; remove it");
    for (Index i = 0; i < n; ++i) {
      const double v = values_->next(list.type);
      if (v < 0 || v >= static_cast<double>(mesh_.positions.cols())) {
        values_->fail("corner " + shown(v) + " is not one of the " +
                      counted(mesh_.positions.cols(), "vertex", "vertices") +
                      ", which are counted from 0");
      }
      need_corners(mesh_, context_);
      mesh_.corners.push_back(static_cast<VertexId>(v));
    }
    mesh_.offsets.push_back(std::ssize(mesh_.corners));
  }

  void skip(const PlyElement& element) {
    if (element.count > 0) {
      mesh_.remarks.push_back("the " + std::to_string(element.count) + " elements " + element.name +
                              " were left out");
    }
    if (element.properties.empty()) return;
    for (Index e = 0; e < element.count; ++e) {
      values_->begin(element.name, e);
      for (const PlyProperty& p : element.properties) skip_value(p);
      values_->end();
    }
  }

  const Context& context_;
  TextLines lines_;
  PlyHeader header_;
  std::unique_ptr<PlyValues> values_;
  PolygonMesh mesh_;
};

}  // namespace

PolygonMesh read_ply(InputFile& file, const Context& context) {
  return PlyReader(file, context).read();
}

}  // namespace dsc::detail
