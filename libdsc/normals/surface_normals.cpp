#include "libdsc/normals/surface_normals.h"

#include "libdsc/base/error.h"
#include "libdsc/surface/digital_surface.h"

namespace dsc {
namespace {

NormalReport write(DigitalSurface& surface, const NormalField& field) {
  surface.set_normals(field.u);
  return {field.fallbacks, field.radius};
}

}  // namespace

NormalReport integral_invariant_normals(DigitalSurface& surface, const BinaryVolume& volume,
                                        const IntegralInvariantOptions& options,
                                        const Context& context) {
  const Grid& a = surface.grid();
  const Grid& b = volume.grid();
  if (a.size != b.size || a.spacing != b.spacing) {
    throw UsageError(
        "normals: the surface comes from another volume; pass the one it was extracted from");
  }
  return write(surface, integral_invariant_normals(volume, surface.surfels(), options, context));
}

NormalReport trivial_normals(DigitalSurface& surface, const Context& context) {
  return write(surface, trivial_normals(surface.flat(false), context));
}

NormalReport analytic_normals(DigitalSurface& surface, const ImplicitShape& shape,
                              const Context& context) {
  return write(surface, analytic_normals(shape, surface.grid(), surface.surfels(), context));
}

}  // namespace dsc
