#include "libdsc/io/mesh_reader.h"

#include "libdsc/io/mesh_formats.h"
#include "libdsc/io/path_extension.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <set>

namespace dsc {
namespace {

using Read = PolygonMesh (*)(InputFile&, const Context&);

struct MeshFormat {
  const char* ending;
  Read read;
};

constexpr std::array<MeshFormat, 5> kFormats{{{".off", detail::read_off},
                                              {".obj", detail::read_obj},
                                              {".ply", detail::read_ply},
                                              {".stl", detail::read_stl},
                                              {".om", detail::read_om}}};

const MeshFormat* format_of(const std::string& path) {
  const std::string ending = extension_of(path);
  for (const MeshFormat& format : kFormats) {
    if (ending == format.ending) return &format;
  }
  return nullptr;
}

const MeshFormat& known_format_of(const std::string& path) {
  const MeshFormat* format = format_of(path);
  if (format == nullptr) {
    throw UsageError("'" + path + "': the ending does not tell the format of a mesh; known are " +
                     mesh_endings());
  }
  return *format;
}

std::string kind_of(const MeshField& field) {
  return field.on == FieldOn::vertex ? "vertex" : "face";
}

/// Writers take letters, digits and underscores, each name once for a kind, and no x, y, z. The
/// name of a vector differs from those of the other fields too, whatever its parts are called.
void make_names_plain(PolygonMesh& mesh) {
  using Names = std::set<std::pair<FieldOn, std::string>>;
  std::map<std::pair<FieldOn, std::string>, int> numbers;
  const auto plain = [&](const MeshField& field, const std::string& given, Names& taken) {
    std::string name = given.empty() ? "_" : given;
    for (char& c : name) {
      if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
    }
    if (name == "x" || name == "y" || name == "z") name += "_";
    if (!taken.insert({field.on, name}).second) {
      name += "_";
      // Numbered from the second on, which stays fast for any number of equal names.
      int& number = numbers[{field.on, name}];
      std::string next = name;
      while (!taken.insert({field.on, next}).second) next = name + std::to_string(++number + 1);
      name = next;
    }
    if (name != given) {
      mesh.remarks.push_back("the " + kind_of(field) + " property '" + given + "' is called " +
                             name + " here");
    }
    return name;
  };
  Names parts;
  for (MeshField& field : mesh.fields) {
    for (std::string& part : field.parts) part = plain(field, part, parts);
  }
  Names names;
  for (MeshField& field : mesh.fields) {
    if (field.parts.size() > 1) continue;
    field.name = field.parts[0];
    names.insert({field.on, field.name});
  }
  for (MeshField& field : mesh.fields) {
    if (field.parts.size() > 1) field.name = plain(field, field.name, names);
  }
}

void leave_out_nan(PolygonMesh& mesh) {
  std::erase_if(mesh.fields, [&](const MeshField& field) {
    const auto at = std::find_if(field.values.begin(), field.values.end(),
                                 [](double value) { return std::isnan(value); });
    if (at == field.values.end()) return false;
    const auto element =
        (at - field.values.begin()) / static_cast<std::ptrdiff_t>(field.parts.size());
    mesh.remarks.push_back("the field " + field.name + " is not a number at " + kind_of(field) +
                           " " + std::to_string(element) + "; it was left out");
    return true;
  });
}

/// Makes the face field normal the mesh's normals, where it can be.
void adopt_normals(PolygonMesh& mesh) {
  const auto field = std::find_if(mesh.fields.begin(), mesh.fields.end(), [](const MeshField& f) {
    return f.on == FieldOn::face && f.name == "normal" && f.parts.size() == 3;
  });
  if (field == mesh.fields.end() || field->values.empty()) return;
  Eigen::Matrix3Xd normals =
      Eigen::Map<const Eigen::Matrix3Xd>(field->values.data(), 3, std::ssize(field->values) / 3);
  for (Index f = 0; f < normals.cols(); ++f) {
    const double length = normals.col(f).norm();
    if (!(std::abs(length - 1.) < 1e-3)) {
      mesh.remarks.push_back("the normal of face " + std::to_string(f) +
                             " is not a unit vector; the normals are kept as a field only");
      return;
    }
    if (std::abs(length - 1.) > 1e-12) normals.col(f) /= length;
  }
  mesh.normals = std::move(normals);
  mesh.fields.erase(field);
}

}  // namespace

Result PolygonMesh::result() const {
  Result result{view(), {}};
  if (normals.cols() > 0) {
    result.fields.push_back(vector_field("normal", {"nx", "ny", "nz"}, FieldOn::face,
                                         {normals.data(), normals.cols()}));
  }
  for (const MeshField& field : fields) {
    result.fields.push_back({field.name, field.parts, field.on, field.values});
  }
  return result;
}

std::string mesh_endings() {
  std::string all;
  for (const MeshFormat& format : kFormats)
    all += (all.empty() ? "" : ", ") + std::string(format.ending);
  return all;
}

bool is_mesh_path(const std::string& path) { return format_of(path) != nullptr; }

PolygonMesh read_mesh(const std::string& path, const Context& context) {
  (void)known_format_of(path);  // before the file is opened
  InputFile file(path, context);
  return detail::read_mesh(file, context);
}

namespace detail {

PolygonMesh read_mesh(InputFile& file, const Context& context) {
  const MeshFormat& format = known_format_of(file.path());
  context.begin("read", file.size());
  PolygonMesh mesh = format.read(file, context);
  leave_out_nan(mesh);
  make_names_plain(mesh);
  adopt_normals(mesh);
  for (std::string& remark : mesh.remarks) remark = printable(std::move(remark));
  return mesh;
}

std::string vector_name(std::string_view a, std::string_view b, std::string_view c) {
  if (a.size() < 2 || a.size() != b.size() || a.size() != c.size()) return "";
  const std::size_t last = a.size() - 1;
  if (a[last] != 'x' || b[last] != 'y' || c[last] != 'z') return "";
  std::string_view stem = a.substr(0, last);
  if (b.substr(0, last) != stem || c.substr(0, last) != stem) return "";
  if (stem == "n") return "normal";
  if (stem == "g") return "gradient";
  if (stem.size() > 1 && stem.back() == '_') stem.remove_suffix(1);
  return std::string(stem);
}

std::vector<std::string> vector_parts(const std::string& name) {
  if (name == "normal") return {"nx", "ny", "nz"};
  if (name == "gradient") return {"gx", "gy", "gz"};
  return {name + "_x", name + "_y", name + "_z"};
}

Eigen::Matrix3Xd columns_of(const std::vector<double>& xyz) {
  return Eigen::Map<const Eigen::Matrix3Xd>(xyz.data(), 3, std::ssize(xyz) / 3);
}

std::string counted(Index n, const std::string& singular, const std::string& plural) {
  return std::to_string(n) + " " + (n == 1 ? singular : plural);
}

}  // namespace detail
}  // namespace dsc
