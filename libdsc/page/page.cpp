#include "libdsc/page/page.h"

#include "libdsc/base/error.h"
#include "libdsc/base/parallel.h"
#include "libdsc/io/atomic_file.h"
#include "libdsc/io/base64.h"
#include "libdsc/page/arrays.h"
#include "libdsc/page/manifest.h"
#include "libdsc/page/packing.h"
#include "libdsc/page/template.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <limits>
#include <numeric>

namespace dsc {
namespace {

/// An element of the page that holds deflated bytes; `content` makes them.
struct Block {
  std::string id;
  Index integers;  ///< that it packs, of 32 bits
  std::function<std::string()> content;
};

std::string packed_values(const Field& field, int& exponent, const Context& context) {
  detail::PageValues kept = detail::page_values(field.values);
  exponent = kept.exponent;
  return detail::packed(kept.values, field.parts.size(), context);
}

/// The numbers of corners, where faces differ in them.
std::string packed_sizes(const FlatMesh& mesh, const Context& context) {
  std::vector<std::int32_t> sizes(static_cast<std::size_t>(mesh.faces()));
  for (Index f = 0; f < mesh.faces(); ++f) {
    sizes[static_cast<std::size_t>(f)] =
        static_cast<std::int32_t>(mesh.first_corner(f + 1) - mesh.first_corner(f));
  }
  return detail::packed(sizes, 1, context);
}

/// The blocks of a result. What they find out about it goes to `page`, which must outlive them.
std::vector<Block> blocks_of(const Result& result, detail::Manifest& page, const Context& context) {
  const FlatMesh& mesh = result.mesh;
  std::vector<Block> blocks;
  blocks.push_back({"three", std::ssize(detail::kThreeJs) / 4,
                    [&] { return detail::deflated(detail::kThreeJs, context); }});
  blocks.push_back({"positions", 3 * mesh.vertices(), [&] {
                      const auto kept = detail::page_positions(mesh.positions, mesh.spacing);
                      page.lattice = kept.lattice;
                      page.origin = kept.origin;
                      page.step = kept.step;
                      return detail::packed(kept.values, 3, context);
                    }});
  const std::size_t components = page.sides > 0 ? static_cast<std::size_t>(page.sides) : 1;
  blocks.push_back({"corners", mesh.corner_count(),
                    [&, components] { return detail::packed(mesh.corners, components, context); }});
  if (page.sides == 0) {
    blocks.push_back({"sizes", mesh.faces(), [&] { return packed_sizes(mesh, context); }});
  }
  if (mesh.has_normals()) {
    blocks.push_back({"normals", 2 * mesh.normals.size, [&] {
                        return detail::packed(detail::page_normals(mesh.normals), 2, context);
                      }});
  }
  for (std::size_t i = 0; i < result.fields.size(); ++i) {
    const Field& field = result.fields[i];
    blocks.push_back({"field" + std::to_string(i), std::ssize(field.values),
                      [&, i] { return packed_values(field, page.exponents[i], context); }});
  }
  return blocks;
}

/// At most: while a block is made, its integers and their bytes apart (8 each), the largest blocks
/// on all threads at once; of all, base64 of what deflation could not shorten (16 / 3).
Index bytes_of(const std::vector<Block>& blocks, const Context& context) {
  std::vector<Index> sizes;
  for (const Block& block : blocks) sizes.push_back(block.integers);
  std::sort(sizes.rbegin(), sizes.rend());
  const auto at_once = std::min<std::ptrdiff_t>(thread_count(context), std::ssize(sizes));
  return 8 * std::accumulate(sizes.begin(), sizes.begin() + at_once, Index{0}) +
         16 * std::accumulate(sizes.begin(), sizes.end(), Index{0}) / 3;
}

void write_blocks(AtomicFile& file, const std::vector<Block>& blocks, const Context& context) {
  std::vector<std::string> texts(blocks.size());
  const auto n = static_cast<Index>(blocks.size());
  context.need("page", bytes_of(blocks, context));
  context.begin("page", n);
  parallel_for(context, n, 1, [&](Index first, Index last) {
    for (Index i = first; i < last; ++i) {
      const Block& block = blocks[static_cast<std::size_t>(i)];
      std::string& text = texts[static_cast<std::size_t>(i)];
      text = "<script type=\"text/plain\" id=\"" + block.id + "\">";
      detail::append_base64(text, block.content());
      text += "</script>\n";
      context.advance(1);
    }
  });
  for (const std::string& text : texts) file.write(text);
}

}  // namespace

bool has_pages() { return true; }

void check_page_path(const std::string& path) { check_writable(path); }

void write_page(const std::string& path, const Result& result, const Context& context) {
  check_page_path(path);
  check_result(result, context);
  if (result.mesh.corner_count() > std::numeric_limits<std::int32_t>::max()) {
    throw LimitError("'" + path + "': a page holds at most 2147483647 corners of faces");
  }
  detail::Manifest page = detail::manifest_of(result);
  page.title = std::filesystem::path(path).stem().string();
  const std::vector<Block> blocks = blocks_of(result, page, context);

  AtomicFile file(path);
  file.write(detail::kPageHead);
  file.write(detail::escaped_text(page.title));
  file.write(detail::kPageBody);
  write_blocks(file, blocks, context);
  file.write("<script type=\"application/json\" id=\"manifest\">" + detail::json_of(page, result) +
             "</script>\n");
  file.write(detail::kPageTail);
  file.commit();
}

}  // namespace dsc
