#include "libdsc/render/glb_file.h"

#include "libdsc/base/error.h"
#include "libdsc/io/atomic_file.h"
#include "libdsc/io/path_extension.h"
#include "libdsc/render/colormap.h"
#include "libdsc/surface/face_triangles.h"

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace dsc::render {
namespace {

/// The binary chunk, and the JSON of the views and accessors into it.
class Chunk {
 public:
  explicit Chunk(Index bytes) { bytes_.reserve(static_cast<std::size_t>(bytes)); }
  /// Adds an array of `count` elements; `type` is one of glTF's numbers of a component, `target`
  /// its use (34962 of vertices, 34963 of indices). \return the number of the accessor.
  template <class T>
  int add(const std::vector<T>& values, const char* shape, std::size_t components, int type,
          int target, const std::string& more = "") {
    views_ += fmt::format("{}{{\"buffer\":0,\"byteOffset\":{},\"byteLength\":{},\"target\":{}}}",
                          count_ > 0 ? "," : "", bytes_.size(), values.size() * sizeof(T), target);
    accessors_ +=
        fmt::format("{}{{\"bufferView\":{},\"componentType\":{},\"count\":{},\"type\":\"{}\"{}}}",
                    count_ > 0 ? "," : "", count_, type, values.size() / components, shape, more);
    const auto* raw = reinterpret_cast<const char*>(values.data());
    bytes_.append(raw, values.size() * sizeof(T));
    bytes_.resize((bytes_.size() + 3) / 4 * 4, '\0');
    return count_++;
  }
  const std::string& bytes() const { return bytes_; }
  const std::string& views() const { return views_; }
  const std::string& accessors() const { return accessors_; }

 private:
  std::string bytes_, views_, accessors_;
  int count_ = 0;
};

constexpr int kFloat = 5126, kUnsignedShort = 5123, kUnsignedInt = 5125;
constexpr int kVertices = 34962, kIndices = 34963;

/// What the vertices of the file are: those of the mesh, or every corner of every face.
struct Points {
  bool per_corner = false;
  std::vector<VertexId> vertex;    ///< of each
  std::vector<std::int32_t> face;  ///< of each, where per corner
  std::vector<std::uint32_t> triangles;
};

Index triangles_of(const FlatMesh& mesh) { return mesh.corner_count() - 2 * mesh.faces(); }

Points points_of(const FlatMesh& mesh, bool per_corner) {
  Points points;
  points.per_corner = per_corner;
  points.triangles.reserve(static_cast<std::size_t>(3 * triangles_of(mesh)));
  if (per_corner) {
    points.vertex.reserve(mesh.corners.size());
    points.face.reserve(mesh.corners.size());
  } else {
    points.vertex.resize(static_cast<std::size_t>(mesh.vertices()));
    for (std::size_t v = 0; v < points.vertex.size(); ++v) {
      points.vertex[v] = static_cast<VertexId>(v);
    }
  }
  for (Index f = 0; f < mesh.faces(); ++f) {
    const auto ids = mesh.face(f);
    const auto first = static_cast<std::uint32_t>(points.vertex.size());
    if (per_corner) {
      points.vertex.insert(points.vertex.end(), ids.begin(), ids.end());
      points.face.insert(points.face.end(), ids.size(), static_cast<std::int32_t>(f));
    }
    for_each_triangle(mesh, f, [&](std::size_t a, std::size_t b, std::size_t c) {
      for (const std::size_t corner : {a, b, c}) {
        points.triangles.push_back(per_corner ? first + static_cast<std::uint32_t>(corner)
                                              : static_cast<std::uint32_t>(ids[corner]));
      }
    });
  }
  return points;
}

void append(std::vector<float>& to, const Vec3& v) {
  for (int k = 0; k < 3; ++k) to.push_back(static_cast<float>(v[k]));
}

/// The normals of the faces, estimated or their own, at the points.
std::vector<float> normals_of(const FlatMesh& mesh, const Points& points) {
  const auto of_face = [&](Index f) -> Vec3 {
    if (mesh.has_normals()) return mesh.normals[f];
    const auto ids = mesh.face(f);
    Vec3 area = Vec3::Zero();  // of a polygon that need not be flat
    const Vec3 start = mesh.positions[ids[0]];
    for (std::size_t i = 1; i + 1 < ids.size(); ++i) {
      area += (mesh.positions[ids[i]] - start).cross(mesh.positions[ids[i + 1]] - start);
    }
    const double length = area.norm();
    return length > 0 ? Vec3(area / length) : Vec3::UnitZ();
  };
  std::vector<float> normals;
  normals.reserve(3 * points.vertex.size());
  if (points.per_corner) {
    for (const std::int32_t f : points.face) append(normals, of_face(f));
    return normals;
  }
  Eigen::Matrix3Xd sums = Eigen::Matrix3Xd::Zero(3, mesh.vertices());
  for (Index f = 0; f < mesh.faces(); ++f) {
    const Vec3 u = of_face(f);
    for (const VertexId v : mesh.face(f)) sums.col(v) += u;
  }
  for (Index v = 0; v < sums.cols(); ++v) {
    const double length = sums.col(v).norm();
    append(normals, length > 1e-12 ? Vec3(sums.col(v) / length) : Vec3::UnitZ());
  }
  return normals;
}

bool has_infinite(const Field& field) {
  return std::any_of(field.values.begin(), field.values.end(),
                     [](double value) { return std::isinf(value); });
}

/// Linear light as glTF has it, 16 bits a channel.
std::vector<std::uint16_t> colours_of(const Field& field, const Points& points) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double value : field.values) {
    if (std::isinf(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  const bool signs = low < 0 && high > 0;
  if (signs) {
    high = std::max(high, -low);
    low = -high;
  }
  const Colormap map(signs ? "polar" : "lagoon");
  const Rgb grey = rgb_of(Lab(0.6, 0, 0));
  std::vector<std::uint16_t> colours;
  colours.reserve(4 * points.vertex.size());
  for (std::size_t p = 0; p < points.vertex.size(); ++p) {
    const auto at = field.on == FieldOn::face ? points.face[p] : points.vertex[p];
    const double value = field.values[static_cast<std::size_t>(at)];
    const Rgb colour =
        std::isinf(value) ? grey : map(high > low ? (value - low) / (high - low) : 0.5);
    for (int k = 0; k < 3; ++k) {
      colours.push_back(
          static_cast<std::uint16_t>(std::lround(65535. * std::clamp(colour[k], 0., 1.))));
    }
    colours.push_back(65535);
  }
  return colours;
}

std::vector<float> values_at(const Field& field, const Points& points) {
  std::vector<float> values;
  values.reserve(points.vertex.size());
  for (const VertexId v : points.vertex) {
    values.push_back(static_cast<float>(field.values[static_cast<std::size_t>(v)]));
  }
  return values;
}

void check(const std::string& path, const Result& result, const Context& context) {
  check_result(result, context);
  const FlatMesh& mesh = result.mesh;
  if (mesh.faces() == 0) throw InputError("'" + path + "': there is no face to write");
  for (Index v = 0; v < mesh.vertices(); ++v) {
    if (!(mesh.positions[v].cwiseAbs().maxCoeff() <= std::numeric_limits<float>::max())) {
      throw InputError("'" + path + "': the position of vertex " + std::to_string(v) +
                       " is beyond floats");
    }
  }
}

/// Whether a field of vertices is kept as values.
bool is_kept(const Field& field) {
  return field.parts.size() == 1 && field.on == FieldOn::vertex && !has_infinite(field);
}

/// What the names of attributes of one's own look like: _HEAT of heat, _HEAT_2 of Heat beside it.
std::string attribute_name(const std::string& field, std::set<std::string>& taken) {
  std::string name = "_" + field;
  std::transform(name.begin(), name.end(), name.begin(), [](char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  });
  const std::string first = name;
  for (int k = 2; !taken.insert(name).second; ++k) name = first + "_" + std::to_string(k);
  return name;
}

void append_word(std::string& out, std::uint32_t word) {
  out.append(reinterpret_cast<const char*>(&word), sizeof word);
}

}  // namespace

bool is_glb_path(const std::string& path) { return extension_of(path) == ".glb"; }

std::vector<std::string> write_glb(const std::string& path, const Result& result,
                                   const Context& context) {
  check(path, result, context);
  context.begin("write", 4);
  const FlatMesh& mesh = result.mesh;
  const auto shown = std::find_if(result.fields.begin(), result.fields.end(),
                                  [](const Field& field) { return field.parts.size() == 1; });
  const bool scalar = shown != result.fields.end();
  const bool per_corner = !scalar || shown->on == FieldOn::face;
  const Index count = per_corner ? mesh.corner_count() : mesh.vertices();
  const auto kept = std::count_if(result.fields.begin(), result.fields.end(), is_kept);
  const Index chunk_bytes =
      (24 + (scalar ? 8 : 0) + 4 * kept) * count + 12 * triangles_of(mesh) + 4 * (kept + 4);
  // Beside it the points and triangles, the positions, and normals on their way.
  context.need("write", chunk_bytes + (per_corner ? 8 : 4) * count + 12 * triangles_of(mesh) +
                            (12 + 36) * count);
  const Points points = points_of(mesh, per_corner);
  context.advance(1);
  context.check();

  Eigen::AlignedBox3d box;
  for (Index v = 0; v < mesh.vertices(); ++v) box.extend(mesh.positions[v]);
  const Vec3 middle = box.center();
  std::vector<float> positions;
  positions.reserve(3 * points.vertex.size());
  Eigen::AlignedBox3f bounds;
  for (const VertexId v : points.vertex) {
    const Vec3 p = mesh.positions[v] - middle;
    append(positions, p);
    bounds.extend(p.cast<float>());
  }
  Chunk chunk(chunk_bytes);
  const auto three = [](const auto& v) { return fmt::format("[{},{},{}]", v[0], v[1], v[2]); };
  std::string attributes =
      fmt::format("\"POSITION\":{}",
                  chunk.add(positions, "VEC3", 3, kFloat, kVertices,
                            ",\"min\":" + three(bounds.min()) + ",\"max\":" + three(bounds.max())));
  attributes += fmt::format(",\"NORMAL\":{}",
                            chunk.add(normals_of(mesh, points), "VEC3", 3, kFloat, kVertices));
  context.advance(1);
  context.check();
  std::vector<std::string> left_out;
  if (scalar) {
    attributes += fmt::format(",\"COLOR_0\":{}",
                              chunk.add(colours_of(*shown, points), "VEC4", 4, kUnsignedShort,
                                        kVertices, ",\"normalized\":true"));
  }
  std::set<std::string> names;
  for (const Field& field : result.fields) {
    context.check();
    if (is_kept(field)) {
      attributes +=
          fmt::format(",\"{}\":{}", attribute_name(field.name, names),
                      chunk.add(values_at(field, points), "SCALAR", 1, kFloat, kVertices));
    } else if (!scalar || &field != &*shown) {
      left_out.push_back(field.name);
    }
  }
  const int indices = chunk.add(points.triangles, "SCALAR", 1, kUnsignedInt, kIndices);
  context.advance(1);
  context.check();

  std::string json = fmt::format(
      "{{\"asset\":{{\"version\":\"2.0\",\"generator\":\"libdsc\"}},\"scene\":0,\"scenes\":[{{"
      "\"nodes\":[0]}}],\"nodes\":[{{\"mesh\":0,\"translation\":{}}}],\"meshes\":[{{"
      "\"primitives\":[{{\"attributes\":{{{}}},\"indices\":{},\"material\":0}}]}}],"
      "\"materials\":[{{\"doubleSided\":true,\"pbrMetallicRoughness\":{{\"metallicFactor\":0,"
      "\"roughnessFactor\":0.8}}}}],\"buffers\":[{{\"byteLength\":{}}}],\"bufferViews\":[{}],"
      "\"accessors\":[{}]}}",
      three(middle), attributes, indices, chunk.bytes().size(), chunk.views(), chunk.accessors());
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::size_t total = 12 + 8 + json.size() + 8 + chunk.bytes().size();
  if (total > std::numeric_limits<std::uint32_t>::max()) {
    throw LimitError("'" + path + "': a .glb file holds at most 4 GiB; write another format");
  }
  AtomicFile file(path);
  std::string head = "glTF";
  append_word(head, 2);
  append_word(head, static_cast<std::uint32_t>(total));
  append_word(head, static_cast<std::uint32_t>(json.size()));
  head += "JSON" + json;
  append_word(head, static_cast<std::uint32_t>(chunk.bytes().size()));
  head += std::string("BIN\0", 4);
  file.write(head);
  file.write(chunk.bytes());
  file.commit();
  context.advance(1);
  return left_out;
}

}  // namespace dsc::render
