/// \file
/// Averaged face normals: the cheapest estimate, the comparison that every other must beat.
///
/// u of a face is the normalised sum of the unit normals of the faces that share a vertex id with
/// it, itself included, each once. It smooths over one voxel only: its error does not fall with the
/// gridstep.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/normals/normal_field.h"
#include "libdsc/surface/flat_mesh.h"

namespace dsc {

/// One normal a face. Surfels count with their own normals, other polygons with their vector areas'
/// directions (nothing where the area is zero). A face keeps its own normal, and is counted in
/// `fallbacks`, where the sum vanishes or does not point to its outer side.
/// \throws InputError on a face without area whose neighbours give no normal either.
NormalField trivial_normals(const FlatMesh& mesh, const Context& context = {});

}  // namespace dsc
