/// \file
/// Integral invariant normals on the interfaces of a label volume.
///
/// On an interface between labels A and B, V = cov(A) + cov(B): the covariances of the voxels of
/// each in the ball, each about its own mean; u is the eigenvector of its smallest eigenvalue,
/// oriented like the surfel. At a junction of three labels this is exact by symmetry at 120
/// degrees, where one label alone tilts by up to 30 degrees and the union is off by 90. The
/// outside, 0, is a label like any other here. Beyond the volume there is nothing but 0; or, with
/// Beyond::continued, what is on the other side of the centre, A for B and B for A, which is exact
/// for a plane (continued_ball.h); third labels and what is beyond on both sides are left out.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/normals/ball_moments.h"
#include "libdsc/normals/integral_invariant.h"
#include "libdsc/voxels/label_volume.h"

#include <span>

namespace dsc {

/// The moments in one ball of the two labels that its surfel separates.
struct InterfaceMoments {
  BallMoments inside;   ///< of the label inside
  BallMoments outside;  ///< of the label outside
  bool third = false;   ///< the ball meets another label
};

/// `centre` in doubled coordinates, at a surfel; `rows` those of its ball.
InterfaceMoments interface_moments(const LabelVolume& volume, const LabelPair& labels,
                                   const BallRows& rows, const Index3& centre);

/// The same, continued beyond the volume.
InterfaceMoments continued_interface_moments(const LabelVolume& volume, const LabelPair& labels,
                                             const BallRows& rows, const Index3& centre);

/// Normals of the interfaces of a label volume.
struct InterfaceNormals : NormalField {
  Index third_label_faces = 0;  ///< faces whose ball meets a label beyond their own two
};

/// One normal a surfel; `labels` are the surfels' own (DigitalSurface::labels). Falls back and
/// throws as on binary volumes; only balls centred on the surfel are offered. \throws UsageError
/// also where labels and surfels differ in number.
InterfaceNormals integral_invariant_normals(const LabelVolume& volume,
                                            std::span<const Surfel> surfels,
                                            std::span<const LabelPair> labels,
                                            const IntegralInvariantOptions& options,
                                            const Context& context = {});

}  // namespace dsc
