#include "libdsc/cli/picture_output.h"

#include "libdsc/base/error.h"

#ifdef DSC_WITH_PICTURES
#include "libdsc/render/png_file.h"
#endif

#include <algorithm>

namespace dsc::cli {

#ifndef DSC_WITH_PICTURES

// check_picture_options() has refused it.
void write_picture(const std::string& path, const Scene&, const Result&, const Result&, Run&) {
  throw UsageError("'" + path + "': this dsc was built without pictures");
}

#else
namespace {

const Field* find_field(const std::vector<Field>& fields, const std::string& name) {
  const auto found = std::find_if(fields.begin(), fields.end(),
                                  [&](const Field& field) { return field.name == name; });
  return found == fields.end() ? nullptr : &*found;
}

/// The field to show; null: the labels, or the surface alone.
const Field* shown_field(const Result& result, const Result& placed, const Options& o) {
  if (o.picture_field.empty()) {
    return result.fields.empty() ? nullptr : &placed.fields.front();
  }
  if (const Field* field = find_field(placed.fields, o.picture_field)) return field;
  std::string known;
  for (const Field& field : placed.fields) known += (known.empty() ? "" : ", ") + field.name;
  throw UsageError("--field " + o.picture_field + ": the result has " +
                   (known.empty() ? "no field" : known));
}

/// Of what --field chose; of other fields, option checks have said so before.
void check_effect_on(const Field& field, const Options& o) {
  if (o.given("--isolines") && (field.on == FieldOn::face || field.parts.size() != 1)) {
    throw UsageError("--isolines has no effect on " + field.name +
                     ", which is no scalar at vertices; leave it out");
  }
  if (o.given("--glyphs") && field.parts.size() != 3) {
    throw UsageError("--glyphs has no effect on " + field.name +
                     ", which is no field of vectors; leave it out");
  }
}

/// The estimated normals as they lie in the world, 3 x F; none where there are none.
Eigen::Matrix3Xd world_normals(const Scene& scene, const Result& result) {
  Vec3View normals = result.mesh.normals;
  if (normals.empty() && scene.polygons) normals = scene.polygons->view().normals;
  if (normals.empty() && !scene.polygons) normals = scene.surface.normals();
  Eigen::Matrix3Xd turned(3, normals.size);
  for (Index f = 0; f < normals.size; ++f) turned.col(f) = scene.input.world.turned(normals[f]);
  return turned;
}

render::Picture draw(const Scene& scene, const Result& result, const Result& placed, Run& run) {
  const Options& o = run.options;
  const Eigen::Matrix3Xd normals = world_normals(scene, result);
  FlatMesh mesh = placed.mesh;
  mesh.normals = {normals.data(), normals.cols()};
  if (o.picture.shading == render::Shading::true_normals && normals.cols() == 0) {
    throw UsageError("--shading true needs estimated normals, which dsc " +
                     std::string(name_of(o.command)) + " has not made here; leave it out");
  }
  if (const Field* field = shown_field(result, placed, o)) {
    check_effect_on(*field, o);
    return render::draw(mesh, *field, o.picture, run.context);
  }
  const Field* inner = find_field(placed.fields, "label_inner");
  const Field* outer = find_field(placed.fields, "label_outer");
  const bool labels = inner != nullptr && outer != nullptr && !scene.polygons;
  return labels ? render::draw_labels(mesh, inner->values, outer->values, o.picture, run.context)
                : render::draw(mesh, o.picture, run.context);
}

}  // namespace

void write_picture(const std::string& path, const Scene& scene, const Result& result,
                   const Result& placed, Run& run) {
  const render::Picture picture = draw(scene, result, placed, run);
  render::write_png(path, picture.image, run.context);
  run.report.pictures.push_back({path, picture.title, picture.colormap, picture.low, picture.high,
                                 picture.isoline_step, picture.missing});
  if (picture.missing > 0) {
    run.warn(std::to_string(picture.missing) + " infinite values are grey in '" + path + "'");
  }
}

#endif

}  // namespace dsc::cli
