/// \file
/// \internal
/// The constants that Poisson's equation leaves open, chosen so that every source is at distance 0.
#pragma once

#include "libdsc/base/types.h"
#include "libdsc/solve/wide_vector.h"

#include <span>

namespace dsc {

/// Subtracts from φ at each vertex the φ of the sources that its heat came from.
///
/// A single source is a plain shift. With several, φ differs among them by the error of the method
/// (about the gridstep); what is subtracted is φ(s) at each source s, carried away from it against
/// the gradient of the heat `w`: at every other vertex it is the mean over the neighbours, weighted
/// by the heat that they send, -A_vu w_u. So the error is removed around each source, and
/// nothing jumps where two fronts meet. Measured on the sphere, 2 to 60 sources, against one shift
/// for all and against holding φ at the sources while solving: the least mean error of the three.
/// `A` is the heat matrix; `sources` without duplicates; vertices without heat keep their φ.
void anchor_sources(Eigen::VectorXd& phi, const SparseMatrix& A, const WideVector& w,
                    std::span<const VertexId> sources);

}  // namespace dsc
