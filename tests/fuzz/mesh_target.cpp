#include "tests/fuzz/mesh_target.h"

#include "libdsc/base/error.h"
#include "libdsc/io/mesh_formats.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/pipe_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <set>

namespace dsc::fuzz {
namespace {

PolygonMesh read(const std::string& ending, std::string_view bytes) {
  InputFile file("fuzz" + ending, bytes);
  return detail::read_mesh(file, kContext);
}

bool is_printable(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= 32 && c < 127; });
}

void check_fields(const PolygonMesh& mesh) {
  const Index faces = std::ssize(mesh.offsets) - 1;
  std::set<std::pair<FieldOn, std::string>> names, fields;
  for (const MeshField& field : mesh.fields) {
    const Index count = field.on == FieldOn::vertex ? mesh.positions.cols() : faces;
    require(!field.parts.empty(), "a field has parts");
    require(fields.insert({field.on, field.name}).second, "fields have names of their own");
    require(std::ssize(field.values) == count * std::ssize(field.parts),
            "a field has a value for each part of each element");
    require(std::none_of(field.values.begin(), field.values.end(),
                         [](double v) { return std::isnan(v); }),
            "no field is NaN");
    for (const std::string& part : field.parts) {
      require(std::all_of(part.begin(), part.end(),
                          [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; }),
              "names are letters, digits and underscores");
      require(names.insert({field.on, part}).second, "names differ");
    }
  }
}

void check(const PolygonMesh& mesh) {
  const Index vertices = mesh.positions.cols();
  require(mesh.positions.allFinite(), "positions are finite");
  require(!mesh.offsets.empty() && mesh.offsets.front() == 0 &&
              mesh.offsets.back() == std::ssize(mesh.corners),
          "offsets span the corners");
  for (std::size_t f = 1; f < mesh.offsets.size(); ++f) {
    require(mesh.offsets[f] - mesh.offsets[f - 1] >= 3, "a face has three corners or more");
  }
  for (const VertexId v : mesh.corners) {
    require(v >= 0 && v < vertices, "a corner is a vertex");
  }
  const Index normals = mesh.normals.cols();
  require(normals == 0 || normals == std::ssize(mesh.offsets) - 1, "every face has a normal");
  for (Index f = 0; f < normals; ++f) {
    require(std::abs(mesh.normals.col(f).norm() - 1) < 2e-3, "normals are unit vectors");
  }
  check_fields(mesh);
  for (const std::string& remark : mesh.remarks) {
    require(is_printable(remark) && remark.size() < 1000, "remarks are printable and short");
  }
}

bool same_bits(const double* a, const double* b, Index n) {
  return n == 0 || std::memcmp(a, b, static_cast<std::size_t>(n) * sizeof(double)) == 0;
}

/// In .om a field by its name; in .ply every part of it as a column of its own, for where three
/// properties make a vector depends on their names, which the first reading may have made plain.
std::map<std::pair<FieldOn, std::string>, std::vector<double>> columns(const PolygonMesh& mesh,
                                                                       bool by_part) {
  std::map<std::pair<FieldOn, std::string>, std::vector<double>> all;
  for (const MeshField& field : mesh.fields) {
    if (!by_part) {
      all[{field.on, field.name}] = field.values;
      continue;
    }
    const std::size_t parts = field.parts.size();
    for (std::size_t k = 0; k < parts; ++k) {
      std::vector<double>& column = all[{field.on, field.parts[k]}];
      for (std::size_t i = k; i < field.values.size(); i += parts)
        column.push_back(field.values[i]);
    }
  }
  return all;
}

void require_equal(const PolygonMesh& a, const PolygonMesh& b) {
  require(a.positions.cols() == b.positions.cols() &&
              same_bits(a.positions.data(), b.positions.data(), a.positions.size()),
          "positions are read back");
  require(a.corners == b.corners && a.offsets == b.offsets, "faces are read back");
}

void require_equal_fields(const PolygonMesh& a, const PolygonMesh& b, bool by_part) {
  require(a.normals.cols() == b.normals.cols() &&
              same_bits(a.normals.data(), b.normals.data(), a.normals.size()),
          "normals are read back");
  const auto x = columns(a, by_part), y = columns(b, by_part);
  require(x.size() == y.size(), "fields are read back");
  for (const auto& [name, values] : x) {
    const auto other = y.find(name);
    require(other != y.end() && other->second.size() == values.size() &&
                same_bits(other->second.data(), values.data(), std::ssize(values)),
            "fields are read back");
  }
}

}  // namespace

void check_mesh_reader(const std::string& ending, std::string_view bytes) {
  const PolygonMesh mesh = read(ending, bytes);
  check(mesh);
  static std::map<std::string, std::unique_ptr<PipeFile>> pipes;
  std::unique_ptr<PipeFile>& pipe = pipes[ending];
  if (pipe == nullptr) pipe = std::make_unique<PipeFile>(ending);
  const auto written = [&](const PolygonMesh& what) {
    (void)write_result(pipe->path(), what.result(), kContext);
    return pipe->take();
  };
  if (ending == ".stl") {  // rounds to floats and cuts faces, so that the second time counts
    const double most = mesh.positions.size() == 0 ? 0 : mesh.positions.cwiseAbs().maxCoeff();
    if (most > std::numeric_limits<float>::max()) return;  // which the writer refuses
    const PolygonMesh rounded = read(ending, written(mesh));
    require_equal(rounded, read(ending, written(rounded)));
    return;
  }
  const PolygonMesh again = read(ending, written(mesh));
  check(again);
  require_equal(mesh, again);
  if (ending == ".ply" || ending == ".om") require_equal_fields(mesh, again, ending == ".ply");
}

}  // namespace dsc::fuzz
