// The numeric part of assembly.
//
// Bytes for a surfel surface, a face (V ≈ F, 9 entries a column): the faces' pass reads 24 (normal)
// and 16 (surfel) and writes 32 (SurfelLaplacian); the columns' pass reads 32, 16 (incident
// corners), 16 (slots), 8 (offsets) and writes 72 (values) and 8 (mass). Floor: 40 in and 80 out.

#include "libdsc/base/parallel.h"
#include "libdsc/calculus/laplacian_pattern.h"
#include "libdsc/calculus/mesh_checks.h"
#include "libdsc/calculus/polygon_kernel.h"
#include "libdsc/calculus/surfel_operators.h"

#include <memory>

namespace dsc {
namespace {

constexpr Index kGrain = 4096;

Index add(Index a, Index b) { return a + b; }

}  // namespace

Index LaplacianPattern::fill_surfels(const FlatMesh& mesh, const CalculusOptions& options,
                                     double* values, double* mass, const Context& context) const {
  const auto shapes = surfel_shapes(mesh.spacing);
  const SurfelLambda lambda(options);
  const auto local =
      std::make_unique_for_overwrite<SurfelLaplacian[]>(static_cast<std::size_t>(faces_));

  const Index clamped = parallel_reduce(
      context, faces_, kGrain, Index{0},
      [&](Index first, Index last) {
        Index count = 0;
        for (Index f = first; f < last; ++f) {
          const int direction = mesh.surfels[static_cast<std::size_t>(f)].direction;
          if (direction < 0 || direction > 5) refuse_direction(mesh, f);
          const SurfelShape& shape = shapes[static_cast<std::size_t>(direction)];
          SurfelLaplacian& cell = local[static_cast<std::size_t>(f)];
          if (mesh.has_normals()) {
            const Vec3 u = mesh.normals[f];
            if (!is_unit(u)) refuse_normal(mesh, f);
            const SurfelOperators surfel(shape, u, options.min_cosine);
            count += surfel.clamped() ? 1 : 0;
            cell = surfel.laplacian();
          } else {
            cell = SurfelOperators(shape).laplacian();
          }
        }
        return count;
      },
      add);

  parallel_for(context, vertices(), kGrain, [&](Index first, Index last) {
    for (Index v = first; v < last; ++v) {
      const auto at = static_cast<std::size_t>(v);
      double* column = values + outer_[at];
      std::fill(column, values + outer_[at + 1], 0.);
      double diagonal = 0.;
      double area = 0.;
      int self = 0;
      for (std::int32_t k = incident_begin_[at]; k < incident_begin_[at + 1]; ++k) {
        const std::int32_t corner = incident_[static_cast<std::size_t>(k)];
        const int i = corner & 3;
        const SurfelLaplacian& cell = local[static_cast<std::size_t>(corner >> 2)];
        const std::uint8_t* slots = surfel_slots_.data() + 4 * static_cast<Index>(corner);
        const double lambda_f = lambda(cell.s);
        const double steep = cell.diagonal(i);
        diagonal += -steep - lambda_f;
        area += cell.area;
        self = slots[i];
        column[slots[i ^ 1]] += cell.d + lambda_f;
        column[slots[i ^ 2]] += steep - lambda_f;
        column[slots[i ^ 3]] += lambda_f - cell.d;
      }
      if (incident_begin_[at] != incident_begin_[at + 1]) column[self] += diagonal;
      mass[v] = 0.25 * area;
    }
    context.advance(last - first);
  });
  return clamped;
}

Index LaplacianPattern::fill_polygons(const FlatMesh& mesh, const CalculusOptions& options,
                                      double* values, double* mass, const Context& context) const {
  const auto local =
      std::make_unique_for_overwrite<double[]>(static_cast<std::size_t>(pairs_before(faces_)));
  std::vector<double> corner_area(static_cast<std::size_t>(faces_));

  const Index clamped = parallel_reduce(
      context, faces_, kGrain / 4, Index{0},
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

  parallel_for(context, vertices(), kGrain, [&](Index first, Index last) {
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
