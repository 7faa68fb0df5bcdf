/// \file
/// \internal
/// One implicit step of heat flow from a few sources, (M0 - t L) w = δ, in linear time and at any
/// distance: band after band along the front.
///
/// Heat at a vertex comes from the side of the sources and, since it decays like
/// exp(-distance / sqrt(t)), hardly from beyond. So number the vertices by breadth-first level from
/// the sources and cut the levels into bands; the system of a band, with a few levels of overlap
/// beyond it where heat is taken to be zero, is solved directly with the heat on the level before
/// the band as Dirichlet data. The bands' factorizations do not depend on one another and run in
/// parallel; the right-hand sides alone follow the front. Where heat does come from beyond, on
/// detours over steep faces that are shorter than they have levels, equations are left unmet: these
/// places are solved again with the heat on both sides as data. Numbers are wide (wide_vector.h):
/// plain doubles would underflow some 700 sqrt(t) from the sources.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/base/types.h"
#include "libdsc/solve/wide_vector.h"

#include <span>

namespace dsc {

struct FrontOptions {
  Index band = 16;    ///< levels a band, at least 1
  Index overlap = 8;  ///< levels beyond a band that its system includes, at least 1
};

struct HeatFront {
  WideVector w;      ///< V; 0 where no source reaches and at fixed vertices
  Index levels = 0;  ///< breadth-first levels, the sources' own included
  Index bands = 0;
  Index repairs = 0;  ///< passes over the places where heat came from ahead of the front
};

/// `A` = M0 - t L, both triangles; `sources` are the vertices where δ = 1, duplicates allowed; at
/// vertices with `fixed` != 0 (V flags, or empty: none) w is 0, sources among them emit nothing.
/// The error relative to the full solve, entry by entry, is about exp(-2 overlap hop / sqrt(t))
/// with hop the distance that the front advances a level: sqrt(t) should not exceed a hop, or
/// `overlap` must grow in proportion (see componentwise_residual). \throws UsageError where a
/// source is out of range, SolverError where a band is singular.
HeatFront diffuse_front(const SparseMatrix& A, std::span<const VertexId> sources,
                        std::span<const char> fixed = {}, const FrontOptions& options = {},
                        const Context& context = {});

/// max_i |A w - δ|_i / (|A| |w| + δ)_i over the free rows: the error of each equation relative to
/// the sizes of its own terms, which tells of the far field what a norm cannot. 1 at worst.
double componentwise_residual(const SparseMatrix& A, const WideVector& w,
                              std::span<const VertexId> sources, std::span<const char> fixed = {},
                              const Context& context = {});

}  // namespace dsc
