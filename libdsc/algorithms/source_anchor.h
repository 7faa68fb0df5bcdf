/// \file
/// The constants that Poisson's equation leaves open, chosen so that every source is at distance 0.
#pragma once

#include "libdsc/base/types.h"
#include "libdsc/solve/wide_vector.h"

#include <span>

namespace dsc {

/// Subtracts from φ at each vertex the φ of the source that its heat came from: the one that
/// steepest ascent in `w` along the entries of `L` leads to. A single source is a plain shift; with
/// several, φ differs among them by the error of the method, which this removes around each.
/// `sources` without duplicates; vertices that no source reaches keep their φ.
void anchor_sources(Eigen::VectorXd& phi, const SparseMatrix& L, const WideVector& w,
                    std::span<const VertexId> sources);

}  // namespace dsc
