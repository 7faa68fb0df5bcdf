// STL, binary (an 80 byte comment, a count, 50 bytes a triangle) or text; see mesh_reader.h.
#include "libdsc/base/checked.h"
#include "libdsc/io/byte_blocks.h"
#include "libdsc/io/mesh_formats.h"
#include "libdsc/io/text_lines.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstring>

namespace dsc::detail {
namespace {

/// Numbers points by their first appearance; equal coordinates are one point.
class PointTable {
 public:
  explicit PointTable(const Context& context) : context_(context) {}
  VertexId operator()(const Vec3& p) {
    if (std::ssize(xyz_) / 3 * 2 >= std::ssize(slots_)) grow();
    VertexId& slot = slots_[find(p)];
    if (slot < 0) {
      slot = checked_id(std::ssize(xyz_) / 3, "vertices");
      xyz_.insert(xyz_.end(), {p[0], p[1], p[2]});
    }
    return slot;
  }
  const std::vector<double>& xyz() const { return xyz_; }

 private:
  static std::uint64_t hash(const Vec3& p) {
    std::uint64_t h = 0;
    for (int k = 0; k < 3; ++k) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, &p[k], sizeof bits);
      h = (h ^ bits) * 0x9e3779b97f4a7c15ULL;
      h ^= h >> 29;
    }
    return h;
  }
  std::size_t find(const Vec3& p) const {
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t i = hash(p) & mask;; i = (i + 1) & mask) {
      if (slots_[i] < 0) return i;
      const double* q = &xyz_[3 * static_cast<std::size_t>(slots_[i])];
      if (q[0] == p[0] && q[1] == p[1] && q[2] == p[2]) return i;
    }
  }
  void grow() {
    // Slots for twice the points; points twice as many, and a copy of them at the end.
    context_.need("read", (4 * 4 + 3 * 24) * (std::ssize(xyz_) / 3));
    slots_.assign(std::max<std::size_t>(64, 2 * slots_.size()), -1);
    for (Index v = 0; v < std::ssize(xyz_) / 3; ++v) {
      const double* q = &xyz_[3 * static_cast<std::size_t>(v)];
      slots_[find({q[0], q[1], q[2]})] = static_cast<VertexId>(v);
    }
  }

  const Context& context_;
  std::vector<double> xyz_;
  std::vector<VertexId> slots_;  ///< open addressing; -1 is free
};

/// Collects triangles; both encodings end here.
class Triangles {
 public:
  explicit Triangles(const Context& context) : table_(context) {}
  void add(const std::array<Vec3, 3>& points) {
    std::array<VertexId, 3> ids{};
    for (std::size_t i = 0; i < 3; ++i) ids[i] = table_(points[i]);
    if (ids[0] == ids[1] || ids[1] == ids[2] || ids[2] == ids[0]) ++degenerate_;
    mesh_.corners.insert(mesh_.corners.end(), ids.begin(), ids.end());
  }
  PolygonMesh finish() {
    checked_id(std::ssize(mesh_.corners), "face corners");
    for (Index c = 0; c <= std::ssize(mesh_.corners); c += 3) mesh_.offsets.push_back(c);
    mesh_.positions = columns_of(table_.xyz());
    if (degenerate_ > 0) {
      mesh_.remarks.push_back(counted(degenerate_, "triangle has", "triangles have") +
                              " two equal corners; they were kept");
    }
    return std::move(mesh_);
  }

 private:
  PointTable table_;
  PolygonMesh mesh_;
  Index degenerate_ = 0;
};

constexpr Index kHeader = 84, kTriangle = 50;

PolygonMesh read_binary_stl(InputFile& file, Index count, const std::function<void(Index)>& on_read,
                            const Context& context) {
  context.need("read", faces_bytes(count));
  Triangles triangles(context);
  file.seek(kHeader);
  ByteBlocks blocks(file, on_read);
  for (Index t = 0; t < count; ++t) {
    const Index at = blocks.position();
    float numbers[12];
    std::memcpy(numbers, blocks.take(kTriangle), sizeof numbers);
    std::array<Vec3, 3> points;
    for (std::size_t i = 0; i < 3; ++i) {
      const float* p = numbers + 3 + 3 * i;
      points[i] = Vec3(p[0], p[1], p[2]) + Vec3::Zero();  // -0 becomes 0
      if (!points[i].allFinite()) {
        file.fail(at, "triangle " + std::to_string(t) +
                          ": a coordinate is not finite; remove the triangle");
      }
    }
    triangles.add(points);
  }
  return triangles.finish();
}

/// Text: keywords and numbers, whatever lines they stand on.
class TextReader {
 public:
  TextReader(InputFile& file, const std::function<void(Index)>& on_read, const Context& context)
      : lines_(file, on_read), triangles_(context) {}

  PolygonMesh read() {
    expect("solid");
    (void)lines_.rest();
    if (!lines_.next()) truncated();
    for (;;) {
      const std::string word = next();
      if (word == "facet") {
        facet();
      } else if (word == "endsolid") {
        if (!further_solid()) return triangles_.finish();
      } else {
        lines_.fail("'" + word + "' stands where facet or endsolid should");
      }
    }
  }

 private:
  [[noreturn]] void truncated() const {
    lines_.fail("the file ends before endsolid; it is truncated");
  }
  std::string next() {
    while (!lines_.more()) {
      if (!lines_.next()) truncated();
    }
    std::string word(lines_.word().substr(0, 40));
    for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return word;
  }
  void expect(const char* keyword) {
    const std::string word = next();
    if (word != keyword) lines_.fail("'" + word + "' stands where " + keyword + " should");
  }
  void facet() {
    expect("normal");
    for (int k = 0; k < 3; ++k) (void)lines_.real("a normal");
    expect("outer");
    expect("loop");
    std::array<Vec3, 3> points;
    for (Vec3& p : points) {
      expect("vertex");
      for (int k = 0; k < 3; ++k) p[k] = lines_.finite("a coordinate") + 0.;
    }
    expect("endloop");
    expect("endfacet");
    triangles_.add(points);
  }
  /// After endsolid and its name: another solid, whose triangles join, or nothing.
  bool further_solid() {
    while (lines_.next()) {
      if (!lines_.more()) continue;
      expect("solid");
      if (!lines_.next()) truncated();
      return true;
    }
    return false;
  }

  TextLines lines_;
  Triangles triangles_;
};

bool begins_with_solid(std::string_view text) {
  constexpr std::string_view kWord = "solid";
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos || text.size() - first < kWord.size()) return false;
  return std::equal(
      kWord.begin(), kWord.end(), text.begin() + static_cast<std::ptrdiff_t>(first),
      [](char a, char b) { return a == std::tolower(static_cast<unsigned char>(b)); });
}

}  // namespace

PolygonMesh read_stl(InputFile& file, const Context& context) {
  const auto on_read = [&](Index bytes) {
    context.check();
    context.advance(bytes);
  };
  // Binary files may begin with "solid" too, so that the size decides.
  Index promised = -1;
  char start[kHeader];
  const Index head = std::min(kHeader, file.size());
  file.read(start, head);
  if (head == kHeader) {
    std::uint32_t count = 0;
    std::memcpy(&count, start + 80, sizeof count);
    promised = count;
    if (file.size() - kHeader == promised * kTriangle) {
      return read_binary_stl(file, promised, on_read, context);
    }
  }
  if (begins_with_solid({start, static_cast<std::size_t>(head)})) {
    file.seek(0);
    return TextReader(file, on_read, context).read();
  }
  if (promised < 0) file.fail(file.size(), "the file is too short for an STL file");
  file.fail(80, std::to_string(promised) + " triangles take " +
                    std::to_string(kHeader + promised * kTriangle) + " bytes, the file has " +
                    std::to_string(file.size()) +
                    (file.size() - kHeader < promised * kTriangle ? "; it is truncated"
                                                                  : "; it is too long"));
}

}  // namespace dsc::detail
