// Wavefront's OBJ: a statement a line. See mesh_reader.h for what is read.
#include "libdsc/base/checked.h"
#include "libdsc/io/mesh_formats.h"
#include "libdsc/io/text_lines.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

namespace dsc::detail {
namespace {

/// Statements that have no part in the mesh's geometry.
constexpr std::array<std::string_view, 15> kSilent{
    "vt",     "vn",     "g",        "o",          "s",         "mg",  "usemtl",  "mtllib",
    "usemap", "maplib", "c_interp", "shadow_obj", "trace_obj", "lod", "d_interp"};

class ObjReader {
 public:
  ObjReader(InputFile& file, const Context& context)
      : context_(context), lines_(file, [&context](Index bytes) {
          context.check();
          context.advance(bytes);
        }) {
    mesh_.offsets.push_back(0);
  }

  PolygonMesh read() {
    while (next_statement()) statement();
    finish();
    return std::move(mesh_);
  }

 private:
  /// A statement goes on in the next line after a backslash.
  bool next_statement() {
    if (!lines_.next()) return false;
    while (lines_.line().ends_with('\\')) {
      joined_.assign(lines_.line().substr(0, lines_.line().size() - 1));
      if (!lines_.next()) lines_.fail("the file ends inside a statement; it is truncated");
      joined_ += ' ';
      joined_ += lines_.line();
      lines_.set_line(joined_);
    }
    const std::size_t comment = lines_.line().find('#', 1);
    if (comment != std::string_view::npos && lines_.line().front() != '#') {
      lines_.drop_comment(comment);
    }
    return true;
  }

  void statement() {
    const std::string_view key = lines_.word();
    if (key.empty()) return;
    if (key.front() == '#') {
      read_counts();
    } else if (key == "v") {
      vertex();
    } else if (key == "f") {
      face();
    } else if (key == "l" || key == "p") {
      ++lines_and_points_;
    } else if (std::find(kSilent.begin(), kSilent.end(), key) == kSilent.end()) {
      lines_.fail("the statement '" + std::string(key.substr(0, 20)) +
                  "' is not read; save the mesh as plain polygons (v and f)");
    }
  }

  void vertex() {
    for (int k = 0; k < 3; ++k) {
      need_room(xyz_, context_);  // the format has no counts
      xyz_.push_back(lines_.finite("a coordinate"));
    }
    // Beyond: a weight, or a colour of three or four parts.
    std::array<double, 5> beyond{};
    std::size_t count = 0;
    while (lines_.more()) {
      if (count == 4) lines_.fail("a vertex has more than 7 numbers");
      beyond[count++] = lines_.real("a number");
    }
    if (count == 1 && beyond[0] != 1.) {
      lines_.fail("a vertex of weight " + std::to_string(beyond[0]) +
                  " is not read, only of weight 1");
    }
    if (count == 2) lines_.fail("a vertex has 5 numbers; 3, a weight or a colour are expected");
    if (count >= 3) ++coloured_;
  }

  void face() {
    need_room(mesh_.offsets, context_);
    std::size_t count = 0;
    const Index vertices = std::ssize(xyz_) / 3;
    for (std::string_view word = lines_.word(); !word.empty(); word = lines_.word(), ++count) {
      const std::size_t slash = word.find('/');
      check_references(word, slash);
      const Index number = lines_.integer(word.substr(0, slash), "a corner");
      const Index v = number < 0 ? vertices + number : number - 1;
      if (v < 0 || v >= vertices) {
        lines_.fail("corner " + std::to_string(number) + " is not one of the " +
                    counted(vertices, "vertex", "vertices") +
                    " before this line, which are counted from 1");
      }
      need_room(mesh_.corners, context_);
      mesh_.corners.push_back(static_cast<VertexId>(checked_id(v, "vertices")));
    }
    if (count < 3) {
      lines_.fail("a face has " + counted(static_cast<Index>(count), "corner", "corners") +
                  "; remove it");
    }
    mesh_.offsets.push_back(std::ssize(mesh_.corners));
  }

  /// v/t, v//n or v/t/n: what follows the slash is left out, but it must be whole.
  void check_references(std::string_view word, std::size_t slash) {
    if (slash == std::string_view::npos) return;
    std::string_view rest = word.substr(slash + 1);
    const std::size_t second = rest.find('/');
    const std::string_view t = rest.substr(0, second);
    if (!t.empty() || second == std::string_view::npos)
      (void)lines_.integer(t, "a corner's texture");
    if (second != std::string_view::npos) {
      (void)lines_.integer(rest.substr(second + 1), "a corner's normal");
    }
  }

  /// The line by which libdsc says how many vertices and faces there are: the format has no counts,
  /// so that a file cut between two lines would go unnoticed.
  void read_counts() {
    constexpr std::string_view kMark = "# libdsc: ";
    std::string_view text = lines_.line();
    if (lines_.number() != 1 || !text.starts_with(kMark)) return;
    text.remove_prefix(kMark.size());
    Counts counts;
    const auto first = std::from_chars(text.data(), text.data() + text.size(), counts.vertices);
    constexpr std::string_view kBetween = " vertices, ";
    std::string_view rest(first.ptr,
                          static_cast<std::size_t>(text.data() + text.size() - first.ptr));
    if (first.ec != std::errc{} || !rest.starts_with(kBetween)) return;
    rest.remove_prefix(kBetween.size());
    const auto second = std::from_chars(rest.data(), rest.data() + rest.size(), counts.faces);
    if (second.ec != std::errc{}) return;
    counts_ = counts;
    lines_.refuse_unended_number();  // whose last line ends, as we wrote it
  }

  void finish() {
    const Index vertices = std::ssize(xyz_) / 3, faces = std::ssize(mesh_.offsets) - 1;
    if (vertices == 0 && !counts_) lines_.fail("the file has no vertex, or is cut off before it");
    if (counts_ && (counts_->vertices != vertices || counts_->faces != faces)) {
      lines_.fail("the first line promises " + std::to_string(counts_->vertices) +
                  " vertices and " + std::to_string(counts_->faces) + " faces, there are " +
                  std::to_string(vertices) + " and " + std::to_string(faces) +
                  "; the file is truncated, or remove the first line");
    }
    context_.need("read", 24 * vertices);
    mesh_.positions = columns_of(xyz_);
    lines_.remark_unended_number(mesh_.remarks);
    if (coloured_ > 0) {
      mesh_.remarks.push_back("the colours of " + counted(coloured_, "vertex", "vertices") +
                              " were left out");
    }
    if (lines_and_points_ > 0) {
      mesh_.remarks.push_back(
          counted(lines_and_points_, "line or point was", "lines and points were") + " left out");
    }
  }

  struct Counts {
    Index vertices = 0, faces = 0;
  };

  const Context& context_;
  TextLines lines_;
  std::string joined_;
  std::vector<double> xyz_;
  PolygonMesh mesh_;
  std::optional<Counts> counts_;
  Index coloured_ = 0, lines_and_points_ = 0;
};

}  // namespace

PolygonMesh read_obj(InputFile& file, const Context& context) {
  return ObjReader(file, context).read();
}

}  // namespace dsc::detail
