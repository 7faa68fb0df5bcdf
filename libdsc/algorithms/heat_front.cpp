#include "libdsc/algorithms/heat_front.h"

#include "libdsc/base/error.h"
#include "libdsc/base/parallel.h"
#include "libdsc/solve/ldlt_factor.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace dsc {
namespace {

/// The free vertices that the sources reach, level after level.
struct Levels {
  std::vector<VertexId> order;  ///< vertices by level
  std::vector<Index> start;     ///< of each level in `order`, and the end
  std::vector<VertexId> place;  ///< V: where in `order`, or -1

  Index count() const { return static_cast<Index>(start.size()) - 1; }
};

Levels breadth_first(const SparseMatrix& A, std::span<const VertexId> sources,
                     std::span<const char> fixed) {
  Levels l;
  l.place.assign(static_cast<std::size_t>(A.rows()), -1);
  const auto visit = [&](VertexId v) {
    auto& place = l.place[static_cast<std::size_t>(v)];
    if (place >= 0 || (!fixed.empty() && fixed[static_cast<std::size_t>(v)] != 0)) return;
    place = static_cast<VertexId>(l.order.size());
    l.order.push_back(v);
  };
  for (const VertexId s : sources) {
    if (s < 0 || s >= A.rows()) {
      throw UsageError("heat: there is no vertex " + std::to_string(s) + " to start from");
    }
    visit(s);
  }
  l.start.push_back(0);
  for (std::size_t first = 0; first < l.order.size();) {
    const std::size_t last = l.order.size();
    l.start.push_back(static_cast<Index>(last));
    for (std::size_t i = first; i < last; ++i) {
      for (SparseMatrix::InnerIterator it(A, l.order[i]); it; ++it) {
        visit(static_cast<VertexId>(it.row()));
      }
    }
    first = last;
  }
  return l;
}

/// The lower triangle of A on the vertices at [first, last) of the order, columns sorted.
SparseMatrix band_matrix(const SparseMatrix& A, const Levels& levels, Index first, Index last) {
  const auto n = static_cast<Eigen::Index>(last - first);
  SparseMatrix band(n, n);
  int* const start = band.outerIndexPtr();
  const auto for_each = [&](auto&& visit) {  // row p ascending, columns q <= p
    for (Index p = first; p < last; ++p) {
      for (SparseMatrix::InnerIterator it(A, levels.order[static_cast<std::size_t>(p)]); it; ++it) {
        const Index q = levels.place[static_cast<std::size_t>(it.row())];
        if (q >= first && q <= p) visit(p - first, q - first, it.value());
      }
    }
  };
  std::fill(start, start + n + 1, 0);
  for_each([&](Index, Index q, double) { ++start[q + 1]; });
  for (Eigen::Index q = 0; q < n; ++q) start[q + 1] += start[q];
  band.resizeNonZeros(start[n]);
  std::vector<int> next(start, start + n);
  for_each([&](Index p, Index q, double value) {
    const int k = next[static_cast<std::size_t>(q)]++;
    band.innerIndexPtr()[k] = static_cast<int>(p);
    band.valuePtr()[k] = value;
  });
  return band;
}

}  // namespace

HeatFront diffuse_front(const SparseMatrix& A, std::span<const VertexId> sources,
                        std::span<const char> fixed, const FrontOptions& options,
                        const Context& context) {
  if (options.band < 1 || options.overlap < 1) {
    throw UsageError("heat: bands and their overlap must have at least one level");
  }
  if (!fixed.empty() && static_cast<Index>(fixed.size()) != A.rows()) {
    throw UsageError("heat: the flags of fixed vertices are those of another mesh");
  }
  const Levels levels = breadth_first(A, sources, fixed);
  HeatFront front;
  front.w = WideVector(A.rows());
  front.levels = levels.count();
  front.bands = (levels.count() + options.band - 1) / options.band;
  const auto start = [&](Index level) {
    return levels.start[static_cast<std::size_t>(std::min(level, levels.count()))];
  };

  // Factorizations in parallel, a group at a time so that memory is that of a few bands.
  const Index group = 4 * static_cast<Index>(thread_count(context));
  std::vector<std::optional<LdltFactor>> factors;
  context.begin("heat", front.bands);
  for (Index k0 = 0; k0 < front.bands; k0 += group) {
    const Index k1 = std::min(front.bands, k0 + group);
    factors.clear();
    factors.resize(static_cast<std::size_t>(k1 - k0));
    parallel_for(context, k1 - k0, 1, [&](Index i, Index) {
      const Index level = (k0 + i) * options.band;
      factors[static_cast<std::size_t>(i)].emplace(
          band_matrix(A, levels, start(level), start(level + options.band + options.overlap)),
          FillOrder::minimum_degree);
    });
    for (Index k = k0; k < k1; ++k) {
      const LdltFactor& factor = *factors[static_cast<std::size_t>(k - k0)];
      const Index first = start(k * options.band);
      WideVector x(factor.size());
      if (k == 0) {
        for (Index p = 0; p < start(1); ++p) x.set(p, {1, 0});
      } else {  // level k * band takes what the level before it gives
        for (Index p = first; p < start(k * options.band + 1); ++p) {
          const VertexId v = levels.order[static_cast<std::size_t>(p)];
          Wide sum;
          for (SparseMatrix::InnerIterator it(A, v); it; ++it) {
            const Index q = levels.place[static_cast<std::size_t>(it.row())];
            if (q < 0 || q >= first) continue;
            sum.add(-it.value() * front.w.mantissa(it.row()), front.w.exponent(it.row()));
          }
          x.set(p - first, sum);
        }
      }
      factor.solve_in_place(x);
      const Index own = start((k + 1) * options.band) - first;
      for (Index p = 0; p < own; ++p) {
        front.w.set(levels.order[static_cast<std::size_t>(first + p)], x[p]);
      }
      context.advance(1);
    }
  }
  return front;
}

double componentwise_residual(const SparseMatrix& A, const WideVector& w,
                              std::span<const VertexId> sources, std::span<const char> fixed,
                              const Context& context) {
  std::vector<char> source(static_cast<std::size_t>(A.rows()), 0);
  for (const VertexId s : sources) source[static_cast<std::size_t>(s)] = 1;
  return parallel_reduce(
      context, A.rows(), 4096, 0.,
      [&](Index first, Index last) {
        double worst = 0;
        for (Index v = first; v < last; ++v) {
          if (!fixed.empty() && fixed[static_cast<std::size_t>(v)] != 0) continue;
          Wide sum, size;
          if (source[static_cast<std::size_t>(v)] != 0) {
            sum.add(-1, 0);
            size.add(1, 0);
          }
          for (SparseMatrix::InnerIterator it(A, v); it; ++it) {
            const double term = it.value() * w.mantissa(it.row());
            sum.add(term, w.exponent(it.row()));
            size.add(std::abs(term), w.exponent(it.row()));
          }
          if (size.mantissa == 0) continue;
          const double shrink = std::ldexp(1., 256 * std::max(-8, sum.exponent - size.exponent));
          const double residual = std::abs(sum.mantissa) * shrink / size.mantissa;
          // Not max(): NaN must win, and stay.
          if (!std::isnan(worst) && !(residual <= worst)) worst = residual;
        }
        return worst;
      },
      [](double a, double b) { return a >= b || a != a ? a : b; });
}

}  // namespace dsc
