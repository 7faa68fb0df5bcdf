#include "libdsc/calculus/global_operators.h"

#include "libdsc/base/checked.h"
#include "libdsc/base/parallel.h"
#include "libdsc/calculus/assembly.h"
#include "libdsc/calculus/mesh_checks.h"
#include "libdsc/calculus/polygon_kernel.h"
#include "libdsc/calculus/vertex_blocks.h"

#include <algorithm>

namespace dsc {
namespace {

constexpr Index kFaceGrain = 1024;

/// What one dimension of a face's dense block is indexed by.
enum class Axis { corner, component, vertex };

/// Appends the global indices of the face's block along `axis`.
void indices(const FlatMesh& mesh, Index face, Axis axis, std::vector<std::int32_t>& out) {
  out.clear();
  const auto ids = mesh.face(face);
  switch (axis) {
    case Axis::corner:
      for (std::size_t i = 0; i < ids.size(); ++i) {
        out.push_back(static_cast<std::int32_t>(mesh.first_corner(face) + static_cast<Index>(i)));
      }
      break;
    case Axis::component:
      for (int k = 0; k < 3; ++k) out.push_back(static_cast<std::int32_t>(3 * face + k));
      break;
    case Axis::vertex:
      out.assign(ids.begin(), ids.end());
      break;
  }
}

Index extent(const FlatMesh& mesh, Axis axis) {
  switch (axis) {
    case Axis::corner:
      return mesh.corner_count();
    case Axis::component:
      return checked_product(3, mesh.faces(), "components of a vector field");
    default:
      return mesh.vertices();
  }
}

/// The matrix whose outer vectors (columns, or rows where `Order` says so) belong to one face each:
/// corners or components. `fill(kernel, block)` writes the face's dense block, outer by outer.
/// Where a face has a vertex twice the entries are summed; the indices of an outer vector come out
/// sorted.
template <int Order, class Fill>
Eigen::SparseMatrix<double, Order> by_face(const FlatMesh& mesh, const CalculusOptions& options,
                                           const Context& context, Axis outer, Axis inner,
                                           Fill&& fill) {
  options.check();
  check_mesh(mesh, options);
  const Index F = mesh.faces();
  const Index outer_size = checked_id(extent(mesh, outer), "columns of an operator");
  const Index inner_size = checked_id(extent(mesh, inner), "rows of an operator");

  // Where each face's entries begin; distinct inner indices times outer ones.
  std::vector<Index> begin(static_cast<std::size_t>(F) + 1, 0);
  parallel_for(context, F, kFaceGrain, [&](Index first, Index last) {
    std::vector<std::int32_t> in, out;
    for (Index f = first; f < last; ++f) {
      indices(mesh, f, inner, in);
      indices(mesh, f, outer, out);
      std::sort(in.begin(), in.end());
      const auto distinct = std::unique(in.begin(), in.end()) - in.begin();
      begin[static_cast<std::size_t>(f) + 1] = distinct * static_cast<Index>(out.size());
    }
  });
  for (std::size_t f = 0; f < static_cast<std::size_t>(F); ++f) begin[f + 1] += begin[f];
  checked_id(begin.back(), "nonzeros of an operator");

  using Matrix = Eigen::SparseMatrix<double, Order>;
  Matrix matrix(Order == Eigen::ColMajor ? inner_size : outer_size,
                Order == Eigen::ColMajor ? outer_size : inner_size);
  matrix.resizeNonZeros(begin.back());
  matrix.outerIndexPtr()[outer_size] = static_cast<std::int32_t>(begin.back());
  parallel_for(context, F, kFaceGrain, [&](Index first, Index last) {
    PolygonKernel kernel(mesh, options);
    std::vector<std::int32_t> in, out, sorted;
    std::vector<double> block;
    for (Index f = first; f < last; ++f) {
      kernel.load(f);
      indices(mesh, f, inner, in);
      indices(mesh, f, outer, out);
      block.resize(in.size() * out.size());
      fill(kernel, block.data());
      sorted = in;
      std::sort(sorted.begin(), sorted.end());
      sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
      Index at = begin[static_cast<std::size_t>(f)];
      for (std::size_t o = 0; o < out.size(); ++o) {
        matrix.outerIndexPtr()[out[o]] = static_cast<std::int32_t>(at);
        double* values = matrix.valuePtr() + at;
        std::copy(sorted.begin(), sorted.end(), matrix.innerIndexPtr() + at);
        std::fill(values, values + sorted.size(), 0.);
        for (std::size_t i = 0; i < in.size(); ++i) {
          const auto place = std::lower_bound(sorted.begin(), sorted.end(), in[i]) - sorted.begin();
          values[place] += block[o * in.size() + i];
        }
        at += static_cast<Index>(sorted.size());
      }
    }
  });
  return matrix;
}

}  // namespace

SparseMatrix mass0_matrix(const FlatMesh& mesh, const CalculusOptions& options,
                          const Context& context) {
  options.check();
  check_mesh(mesh, options);
  const Index V = mesh.vertices();
  SparseMatrix mass(V, V);
  mass.resizeNonZeros(V);
  for (Index v = 0; v < V; ++v) {
    mass.outerIndexPtr()[v] = mass.innerIndexPtr()[v] = static_cast<std::int32_t>(v);
    mass.valuePtr()[v] = 0.;
  }
  mass.outerIndexPtr()[V] = static_cast<std::int32_t>(V);
  const VertexBlocks blocks(mesh, context);
  blocks.run(context, [&](VertexId v0, VertexId v1, Index f0, Index f1) {
    PolygonKernel kernel(mesh, options);
    for (Index f = f0; f < f1; ++f) {
      kernel.load(f);
      const double part = kernel.area() / static_cast<double>(kernel.corners());
      for (const VertexId v : mesh.face(f)) {
        if (v >= v0 && v < v1) mass.valuePtr()[v] += part;
      }
    }
  });
  return mass;
}

SparseMatrix mass1_matrix(const FlatMesh& mesh, const CalculusOptions& options,
                          const Context& context) {
  return by_face<Eigen::ColMajor>(
      mesh, options, context, Axis::corner, Axis::corner,
      [](PolygonKernel& kernel, double* block) { kernel.mass1(block); });
}

SparseMatrix difference_matrix(const FlatMesh& mesh, const Context& context) {
  check_mesh(mesh, CalculusOptions());
  const VertexBlocks checked(mesh, context);  // that every corner is a vertex
  using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  Rows D(mesh.corner_count(), mesh.vertices());
  D.reserve(2 * mesh.corner_count());
  for (Index f = 0; f < mesh.faces(); ++f) {
    const auto ids = mesh.face(f);
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const Index row = mesh.first_corner(f) + static_cast<Index>(i);
      const VertexId from = ids[i];
      const VertexId to = ids[i + 1 == ids.size() ? 0 : i + 1];
      D.startVec(row);
      if (from == to) continue;  // a loop: the difference is 0
      D.insertBack(row, std::min(from, to)) = from < to ? -1. : 1.;
      D.insertBack(row, std::max(from, to)) = from < to ? 1. : -1.;
    }
  }
  D.finalize();
  return D;
}

SparseMatrix gradient_matrix(const FlatMesh& mesh, const CalculusOptions& options,
                             const Context& context) {
  return by_face<Eigen::RowMajor>(mesh, options, context, Axis::component, Axis::vertex,
                                  [](PolygonKernel& kernel, double* block) {
                                    const Index n = kernel.corners();
                                    for (Index j = 0; j < n; ++j) {
                                      const Vec3 g = kernel.gradient(j);
                                      for (int k = 0; k < 3; ++k) block[k * n + j] = g[k];
                                    }
                                  });
}

SparseMatrix flat_matrix(const FlatMesh& mesh, const CalculusOptions& options,
                         const Context& context) {
  return by_face<Eigen::ColMajor>(mesh, options, context, Axis::component, Axis::corner,
                                  [](PolygonKernel& kernel, double* block) {
                                    const Index n = kernel.corners();
                                    for (Index i = 0; i < n; ++i) {
                                      const Vec3 row = kernel.flat(i);
                                      for (int k = 0; k < 3; ++k) block[k * n + i] = row[k];
                                    }
                                  });
}

SparseMatrix sharp_matrix(const FlatMesh& mesh, const CalculusOptions& options,
                          const Context& context) {
  return by_face<Eigen::ColMajor>(mesh, options, context, Axis::corner, Axis::component,
                                  [](PolygonKernel& kernel, double* block) {
                                    for (Index i = 0; i < kernel.corners(); ++i) {
                                      const Vec3 column = kernel.sharp(i);
                                      std::copy(column.data(), column.data() + 3, block + 3 * i);
                                    }
                                  });
}

SparseMatrix divergence_matrix(const FlatMesh& mesh, const CalculusOptions& options,
                               const Context& context) {
  return by_face<Eigen::ColMajor>(mesh, options, context, Axis::corner, Axis::vertex,
                                  [](PolygonKernel& kernel, double* block) {
                                    const auto n = static_cast<std::size_t>(kernel.corners());
                                    std::vector<double> mass(n * n);
                                    kernel.mass1(mass.data());
                                    // Row i of −Dᵀ M1: what runs out of corner i along its edge,
                                    // less what runs in.
                                    for (std::size_t c = 0; c < n; ++c) {
                                      for (std::size_t i = 0; i < n; ++i) {
                                        const std::size_t before = i == 0 ? n - 1 : i - 1;
                                        block[c * n + i] = mass[i * n + c] - mass[before * n + c];
                                      }
                                    }
                                  });
}

SparseMatrix laplacian_matrix(const FlatMesh& mesh, const CalculusOptions& options,
                              const Context& context) {
  return assemble_laplacian(mesh, options, context).L;
}

}  // namespace dsc
