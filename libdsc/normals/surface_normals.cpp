#include "libdsc/normals/surface_normals.h"

#include "libdsc/base/error.h"
#include "libdsc/surface/digital_surface.h"

namespace dsc {
namespace {

/// The estimates, and the property that they are copied to.
void need_normals(const DigitalSurface& surface, const Context& context) {
  context.need("normals", 2 * 24 * surface.face_count());
}

NormalReport write(DigitalSurface& surface, const NormalField& field) {
  surface.set_normals(field.u);
  return {field.fallbacks, field.radius, field.cut_faces, 0};
}

void check_grid(const DigitalSurface& surface, const Grid& grid) {
  if (surface.grid().size != grid.size || surface.grid().spacing != grid.spacing) {
    throw UsageError(
        "normals: the surface comes from another volume; pass the one it was extracted from");
  }
}

}  // namespace

NormalReport integral_invariant_normals(DigitalSurface& surface, const BinaryVolume& volume,
                                        const IntegralInvariantOptions& options,
                                        const Context& context) {
  check_grid(surface, volume.grid());
  need_normals(surface, context);
  return write(surface, integral_invariant_normals(volume, surface.surfels(), options, context));
}

NormalReport integral_invariant_normals(DigitalSurface& surface, const LabelVolume& volume,
                                        const IntegralInvariantOptions& options,
                                        const Context& context) {
  check_grid(surface, volume.grid());
  if (surface.labels().empty() && surface.face_count() > 0) {
    throw UsageError("normals: the surface has no labels; extract it from the label volume");
  }
  need_normals(surface, context);
  const InterfaceNormals field =
      integral_invariant_normals(volume, surface.surfels(), surface.labels(), options, context);
  NormalReport report = write(surface, field);
  report.third_label_faces = field.third_label_faces;
  return report;
}

NormalReport trivial_normals(DigitalSurface& surface, const Context& context) {
  // And the faces at each vertex.
  context.need("normals", (2 * 24 + 16) * surface.face_count() + 8 * surface.vertex_count());
  return write(surface, trivial_normals(surface.flat(false), context));
}

NormalReport analytic_normals(DigitalSurface& surface, const ImplicitShape& shape,
                              const Context& context) {
  need_normals(surface, context);
  return write(surface, analytic_normals(shape, surface.grid(), surface.surfels(), context));
}

}  // namespace dsc
