/// \file
/// Systems with known structure: graph Laplacians of grids.
#pragma once

#include "libdsc/base/types.h"

#include <vector>

namespace dsc::testing {

/// D - W of the n x m grid graph with 4 neighbours a vertex: positive semi-definite, kernel
/// constants. `copies` disjoint grids one after the other.
inline SparseMatrix grid_laplacian(Index n, Index m, Index copies = 1) {
  std::vector<Eigen::Triplet<double>> entries;
  const auto edge = [&](Index a, Index b) {
    entries.emplace_back(a, a, 1.);
    entries.emplace_back(b, b, 1.);
    entries.emplace_back(a, b, -1.);
    entries.emplace_back(b, a, -1.);
  };
  for (Index c = 0; c < copies; ++c) {
    for (Index i = 0; i < n; ++i) {
      for (Index j = 0; j < m; ++j) {
        const Index v = (c * n + i) * m + j;
        if (i + 1 < n) edge(v, v + m);
        if (j + 1 < m) edge(v, v + 1);
      }
    }
  }
  SparseMatrix L(copies * n * m, copies * n * m);
  L.setFromTriplets(entries.begin(), entries.end());
  return L;
}

inline SparseMatrix identity(Index n) {
  SparseMatrix I(n, n);
  I.setIdentity();
  return I;
}

/// Reproducible values in (-1, 1) without a pattern.
inline Eigen::VectorXd scrambled(Index n, std::uint64_t state = 1) {
  Eigen::VectorXd x(n);
  for (Index i = 0; i < n; ++i) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    x[i] = static_cast<double>(state >> 11) * 0x1p-52 - 1.;
  }
  return x;
}

}  // namespace dsc::testing
