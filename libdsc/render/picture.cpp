#include "libdsc/render/picture.h"

#include "libdsc/base/error.h"
#include "libdsc/base/parallel.h"
#include "libdsc/render/glyphs.h"
#include "libdsc/render/legend.h"
#include "libdsc/render/ticks.h"
#include "libdsc/render/tile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace dsc::render {
namespace {

constexpr int kTile = 48;
constexpr Index kBoxBytes = 120;  // of Embree, a quad

void check_mesh(const FlatMesh& mesh) {
  if (mesh.faces() == 0) throw InputError("there is nothing to draw: the surface has no face");
  for (std::size_t c = 0; c < mesh.corners.size(); ++c) {
    const VertexId v = mesh.corners[c];
    if (v < 0 || v >= mesh.vertices()) {
      throw InputError(
          fmt::format("corner {} of the mesh is vertex {} of {}", c, v, mesh.vertices()));
    }
  }
  for (Index v = 0; v < mesh.vertices(); ++v) {
    if (!mesh.positions[v].allFinite()) {
      throw InputError(fmt::format("the position of vertex {} is not finite", v));
    }
  }
}

void check_no_arrows(const PictureOptions& options) {
  if (options.glyphs > 0) throw UsageError("arrows show vectors, and there are none here");
}

bool uses_true_normals(const FlatMesh& mesh, Shading shading) {
  if (mesh.has_normals() && mesh.normals.size != mesh.faces()) {
    throw UsageError(fmt::format("{} normals for {} faces", mesh.normals.size, mesh.faces()));
  }
  if (shading == Shading::true_normals && !mesh.has_normals()) {
    throw UsageError("there are no estimated normals to shade by; use flat shading");
  }
  return shading != Shading::flat && mesh.has_normals();
}

/// Less what the longest of so many arrows reach out of the surface, at most a fifth.
Rectangle with_room_for_arrows(const Rectangle& area, int glyphs) {
  const double shorter = std::min(area.width, area.height);
  const double reach = std::min(0.2 * shorter, 1.3 * shorter / std::sqrt(glyphs));
  return {area.left + reach, area.top + reach, area.width - 2 * reach, area.height - 2 * reach};
}

Picture draw_painted(const FlatMesh& mesh, const Paint& paint, const Field* vectors,
                     const PictureOptions& options, const Context& context) {
  const bool true_normals = uses_true_normals(mesh, options.shading);
  context.need("draw", static_cast<Index>(sizeof(Pixel)) * options.width * options.height);
  Picture picture;
  picture.image = Image(options.width, options.height);
  const double shorter = std::min(options.width, options.height);
  Canvas canvas(picture.image, std::max(1.1, shorter / 410));
  const Key key = options.key ? paint.key() : Key();
  const double margin = options.margin * shorter;
  const double key_wide =
      std::min(0.5 * options.width, key_width(key, canvas, options.height - 2 * margin));
  const double right = key_wide > 0 ? key_wide + margin : 0;
  Rectangle area{margin, margin, std::max(1., options.width - 2 * margin - right),
                 std::max(1., options.height - 2 * margin)};
  if (vectors != nullptr && options.glyphs > 0) area = with_room_for_arrows(area, options.glyphs);

  picture.title = key.title;
  picture.missing = paint.missing();
  const Key colours = paint.key();
  if (colours.map) {
    picture.colormap = colours.map->name();
    picture.low = colours.low;
    picture.high = colours.high;
    if (paint.has_isolines()) {
      picture.isoline_step = round_step(colours.low, colours.high, options.isolines);
    }
  }

  // Floats and numbers of the corners twice over, and Embree's boxes around them: measured.
  context.need("draw", 12 * mesh.vertices() + 4 * mesh.corner_count() + kBoxBytes * mesh.faces());
  context.begin("draw", options.height);
  const Camera camera(options.view, mesh, area);
  const Tracer surface(mesh, camera, context);
  ArrowMesh arrows;
  std::optional<Tracer> arrow_tracer;
  FlatMesh arrow_view;
  if (vectors != nullptr && options.glyphs > 0) {
    arrows = make_arrows(mesh, *vectors, options.glyphs, surface, camera, area, context);
    arrow_view = arrows.view();
    if (arrow_view.faces() > 0) arrow_tracer.emplace(arrow_view, Camera(), context);
  }
  const Scene scene{mesh,
                    surface,
                    paint,
                    camera,
                    {options.ambient},
                    true_normals,
                    &arrow_view,
                    arrow_tracer ? &*arrow_tracer : nullptr,
                    picture.isoline_step,
                    std::max(1.2, shorter / 500),
                    Rgb(0.01, 0.01, 0.015),
                    0.85,
                    colours.map && colours.map->diverging(),
                    sample_points(options.samples)};
  const int across = (options.width + kTile - 1) / kTile,
            down = (options.height + kTile - 1) / kTile;
  parallel_for(context, Index{across} * down, 1, [&](Index first, Index last) {
    for (Index t = first; t < last; ++t) {
      const int x = kTile * static_cast<int>(t % across), y = kTile * static_cast<int>(t / across);
      draw_tile(scene, x, y, std::min(x + kTile, options.width),
                std::min(y + kTile, options.height), picture.image);
      if (t % across == 0) context.advance(std::min(kTile, options.height - y));
    }
  });
  if (key_wide > 0) {
    draw_key(key, picture.isoline_step, scene.line_colour, canvas,
             {options.width - margin - key_wide, margin, key_wide, options.height - 2 * margin});
  }
  return picture;
}

}  // namespace

void PictureOptions::check() const {
  const auto refuse = [](const std::string& text) { throw UsageError("picture: " + text); };
  if (width < 16 || height < 16 || width > 16384 || height > 16384) {
    refuse(fmt::format("{} x {} pixels; each side has 16 to 16384", width, height));
  }
  if (range &&
      !((*range)[0] < (*range)[1] && std::isfinite((*range)[0]) && std::isfinite((*range)[1]))) {
    refuse(fmt::format("the range {} to {}; its ends are finite and ascend", (*range)[0],
                       (*range)[1]));
  }
  if (isolines < 0 || isolines > 1000) refuse("0 to 1000 isolines");
  if (glyphs < 0 || glyphs > 100000) refuse("0 to 100000 glyphs");
  if (samples < 1 || samples > 64) refuse("1 to 64 samples");
  if (!(ambient >= 0 && ambient <= 1)) refuse("ambient light is 0 to 1");
  if (!(margin >= 0 && margin < 0.4)) refuse("the margin is 0 to 0.4");
  if (!colormap.empty()) Colormap{colormap};
}

Picture draw(const FlatMesh& mesh, const PictureOptions& options, const Context& context) {
  options.check();
  check_mesh(mesh);
  check_no_arrows(options);
  return draw_painted(mesh, *plain_paint(), nullptr, options, context);
}

Picture draw(const FlatMesh& mesh, const Field& field, const PictureOptions& options,
             const Context& context) {
  options.check();
  check_mesh(mesh);
  context.need("draw", 8 * std::ssize(field.values));  // or their lengths
  const auto paint = field_paint(mesh, field, options.colormap, options.range);
  if (field.parts.size() != 3) check_no_arrows(options);
  return draw_painted(mesh, *paint, field.parts.size() == 3 ? &field : nullptr, options, context);
}

Picture draw_labels(const FlatMesh& mesh, std::span<const double> inner,
                    std::span<const double> outer, const PictureOptions& options,
                    const Context& context) {
  options.check();
  check_mesh(mesh);
  const auto faces = static_cast<std::size_t>(mesh.faces());
  if (inner.size() != faces || outer.size() != faces) {
    throw UsageError(
        fmt::format("{} and {} labels for {} faces", inner.size(), outer.size(), faces));
  }
  check_no_arrows(options);
  context.need("draw", 16 * mesh.faces());
  return draw_painted(mesh, *label_paint(inner, outer), nullptr, options, context);
}

}  // namespace dsc::render
