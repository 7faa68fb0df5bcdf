// The numeric part of assembly.
//
// Bytes for a surfel surface, a face (V ≈ F, 9 entries a column): 24 (normal), 16 (surfel), 16
// (incident corners), 16 (slots) and 8 (offsets) in, 72 (values) and 8 (mass) out. The 32 of its
// SurfelLaplacian stay in the cache: faces are computed for one block of vertices after the other.
// On one thread that takes twice the time of copying as many bytes.

#include "libdsc/base/parallel.h"
#include "libdsc/calculus/laplacian_pattern.h"
#include "libdsc/calculus/mesh_checks.h"
#include "libdsc/calculus/polygon_kernel.h"
#include "libdsc/calculus/surfel_operators.h"

#include <algorithm>
#include <memory>

namespace dsc {
namespace {

constexpr Index kFillGrain = 4096;

/// Asks for memory that will be written soon.
void prefetch([[maybe_unused]] const double* address) {
#ifdef __GNUC__
  __builtin_prefetch(address, 1);
#endif
}

Index add(Index a, Index b) { return a + b; }

}  // namespace

Index LaplacianPattern::fill_surfels(const FlatMesh& mesh, const CalculusOptions& options,
                                     double* values, double* mass, const Context& context) const {
  const auto shapes = surfel_shapes(mesh.spacing);
  const SurfelLambda lambda(options);

  // Writes the Laplacians of faces [first, last) to `local`; returns how many from `own` on were
  // clamped.
  const auto faces = [&](Index first, Index last, Index own, SurfelLaplacian* local) {
    Index clamped = 0;
    for (Index f = first; f < last; ++f) {
      const int direction = mesh.surfels[static_cast<std::size_t>(f)].direction;
      if (direction < 0 || direction > 5) refuse_direction(mesh, f);
      const SurfelShape& shape = shapes[static_cast<std::size_t>(direction)];
      if (mesh.has_normals()) {
        const Vec3 u = mesh.normals[f];
        if (!is_unit(u)) refuse_normal(mesh, f);
        const SurfelOperators surfel(shape, u, options.min_cosine);
        clamped += surfel.clamped() && f >= own ? 1 : 0;
        *local++ = surfel.laplacian();
      } else {
        *local++ = SurfelOperators(shape).laplacian();
      }
    }
    return clamped;
  };
  // Few enough columns that they are still in the nearest cache after they have been cleared, about
  // 9 entries each.
  constexpr Index kColumns = 128;
  // Gathers the columns of vertices [first, last); local[0] is that of face `first_face`.
  const auto columns = [&](Index first, Index last, const SurfelLaplacian* local,
                           Index first_face) {
    std::fill(values + outer_[static_cast<std::size_t>(first)],
              values + outer_[static_cast<std::size_t>(last)], 0.);
    for (Index v = first; v < last; ++v) {
      const auto at = static_cast<std::size_t>(v);
      double* column = values + outer_[at];
      const Index next = outer_[at] + 9 * kColumns;  // what is cleared next
      prefetch(values + std::min(next, nonzeros()));
      prefetch(values + std::min(next + 8, nonzeros()));
      double diagonal = 0.;
      double area = 0.;
      const auto begin = static_cast<std::size_t>(incident_begin_[at]);
      const auto end = static_cast<std::size_t>(incident_begin_[at + 1]);
      for (std::size_t k = begin; k < end; ++k) {
        const std::int32_t corner = incident_[k];
        const SurfelLaplacian& cell = local[(corner >> 2) - first_face];
        const auto& slots = surfel_slots_[k];
        const double lambda_f = lambda(cell.s);
        const double steep = cell.diagonal(corner & 3);
        diagonal += -steep - lambda_f;
        area += cell.area;
        column[slots[1]] += cell.d + lambda_f;
        column[slots[2]] += steep - lambda_f;
        column[slots[3]] += lambda_f - cell.d;
      }
      if (begin != end) column[surfel_slots_[begin][0]] += diagonal;
      mass[v] = 0.25 * area;
    }
  };
  const auto all_columns = [&](Index first, Index last, const SurfelLaplacian* local,
                               Index first_face) {
    for (Index v = first; v < last; v += kColumns) {
      columns(v, std::min(v + kColumns, last), local, first_face);
    }
    context.advance(last - first);
  };

  if (blocks_.empty()) {
    const auto local =
        std::make_unique_for_overwrite<SurfelLaplacian[]>(static_cast<std::size_t>(faces_));
    const Index clamped = parallel_reduce(
        context, faces_, kFillGrain, Index{0},
        [&](Index first, Index last) { return faces(first, last, first, local.get() + first); },
        add);
    parallel_for(context, vertices(), kFillGrain,
                 [&](Index first, Index last) { all_columns(first, last, local.get(), 0); });
    return clamped;
  }
  return parallel_reduce(
      context, static_cast<Index>(blocks_.size()), 1, Index{0},
      [&](Index b, Index) {
        const Block& block = blocks_[static_cast<std::size_t>(b)];
        const auto local = std::make_unique_for_overwrite<SurfelLaplacian[]>(
            static_cast<std::size_t>(block.last_face - block.first_face));
        const Index clamped = faces(block.first_face, block.last_face, block.own_face, local.get());
        all_columns(block.first_vertex, block.last_vertex, local.get(), block.first_face);
        return clamped;
      },
      add);
}

Index LaplacianPattern::fill_polygons(const FlatMesh& mesh, const CalculusOptions& options,
                                      double* values, double* mass, const Context& context) const {
  const auto local =
      std::make_unique_for_overwrite<double[]>(static_cast<std::size_t>(pairs_before(faces_)));
  std::vector<double> corner_area(static_cast<std::size_t>(faces_));

  const Index clamped = parallel_reduce(
      context, faces_, kFillGrain / 4, Index{0},
      [&](Index first, Index last) {
        Index count = 0;
        PolygonKernel kernel(mesh, options);
        for (Index f = first; f < last; ++f) {
          kernel.load(f);
          count += kernel.clamped() ? 1 : 0;
          kernel.laplacian(local.get() + pairs_before(f));
          corner_area[static_cast<std::size_t>(f)] =
              kernel.area() / static_cast<double>(kernel.corners());
        }
        return count;
      },
      add);

  parallel_for(context, vertices(), kFillGrain, [&](Index first, Index last) {
    for (Index v = first; v < last; ++v) {
      const auto at = static_cast<std::size_t>(v);
      double* column = values + outer_[at];
      std::fill(column, values + outer_[at + 1], 0.);
      mass[v] = 0.;
      for (std::int32_t k = incident_begin_[at]; k < incident_begin_[at + 1]; ++k) {
        const Place here = place(mesh, k);
        const auto n = static_cast<Index>(mesh.face(here.face).size());
        const Index row = pairs_before(here.face) + here.corner * n;
        for (Index j = 0; j < n; ++j) {
          column[polygon_slots_[static_cast<std::size_t>(row + j)]] +=
              local[static_cast<std::size_t>(row + j)];
        }
        mass[v] += corner_area[static_cast<std::size_t>(here.face)];
      }
    }
    context.advance(last - first);
  });
  return clamped;
}

}  // namespace dsc
