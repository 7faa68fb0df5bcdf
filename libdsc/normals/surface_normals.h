/// \file
/// The estimators on a DigitalSurface: each writes the face property `dsc:normal` and reports.
///
/// Where one throws, the surface keeps the normals that it had.
#pragma once

#include "libdsc/normals/analytic.h"
#include "libdsc/normals/integral_invariant.h"
#include "libdsc/normals/label_invariant.h"
#include "libdsc/normals/trivial.h"

namespace dsc {

class DigitalSurface;

/// What was written; the normals themselves are surface.normals().
struct NormalReport {
  Index fallbacks = 0;          ///< faces that kept their own normal
  double radius = 0;            ///< world radius of the ball; 0 where the estimator has none
  Index cut_faces = 0;          ///< faces whose ball was continued beyond the volume
  Index third_label_faces = 0;  ///< of label volumes: faces whose ball meets a third label
};

/// `volume` is the one that the surface was extracted from. \throws UsageError where its grid has
/// another size or spacing; otherwise as on surfels.
NormalReport integral_invariant_normals(DigitalSurface& surface, const BinaryVolume& volume,
                                        const IntegralInvariantOptions& options,
                                        const Context& context = {});

/// For surfaces of label volumes. \throws UsageError also where the surface has no labels.
NormalReport integral_invariant_normals(DigitalSurface& surface, const LabelVolume& volume,
                                        const IntegralInvariantOptions& options,
                                        const Context& context = {});

/// Of the surfels themselves, averaged (trivial.h). \throws as on meshes.
NormalReport trivial_normals(DigitalSurface& surface, const Context& context = {});

/// Of the shape that was digitized (analytic.h). \throws as on surfels.
NormalReport analytic_normals(DigitalSurface& surface, const ImplicitShape& shape,
                              const Context& context = {});

}  // namespace dsc
