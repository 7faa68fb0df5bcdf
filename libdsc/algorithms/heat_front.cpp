#include "libdsc/algorithms/heat_front.h"

#include "libdsc/algorithms/heat_levels.h"
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

constexpr double kUnmet = 3e-4;  // the residual of an equation that is worth a repair
constexpr Index kRepairs = 8;

/// The lower triangle of A on the vertices at [first, last) of the order, columns sorted.
SparseMatrix band_matrix(const SparseMatrix& A, const HeatLevels& levels, Index first, Index last) {
  const auto n = static_cast<Eigen::Index>(last - first);
  SparseMatrix band(n, n);
  int* const start = band.outerIndexPtr();
  const auto for_each = [&](auto&& visit) {  // row p ascending, columns q <= p
    for (Index p = first; p < last; ++p) {
      for (SparseMatrix::InnerIterator it(A, levels.vertex(p)); it; ++it) {
        const Index q = levels.position(it.row());
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

/// What the positions outside [first, last) send to `position`.
Wide arriving_heat(const SparseMatrix& A, const HeatLevels& levels, const WideVector& w,
                   Index first, Index last, Index position) {
  Wide sum;
  for (SparseMatrix::InnerIterator it(A, levels.vertex(position)); it; ++it) {
    const Index q = levels.position(it.row());
    if (q < 0 || (q >= first && q < last)) continue;
    sum.add(-it.value() * w.mantissa(it.row()), w.exponent(it.row()));
  }
  return sum;
}

/// |A w - δ|_v / (|A| |w| + δ)_v, 0 where all of it is 0.
double row_residual(const SparseMatrix& A, const WideVector& w, Index v, bool source) {
  Wide sum, size;
  if (source) {
    sum.add(-1, 0);
    size.add(1, 0);
  }
  for (SparseMatrix::InnerIterator it(A, v); it; ++it) {
    const double term = it.value() * w.mantissa(it.row());
    sum.add(term, w.exponent(it.row()));
    size.add(std::abs(term), w.exponent(it.row()));
  }
  if (size.mantissa == 0) return 0;
  const double shrink = std::ldexp(1., 256 * std::max(-8, sum.exponent - size.exponent));
  return std::abs(sum.mantissa) * shrink / size.mantissa;
}

/// Sweeps over the bands of one front.
class Front {
 public:
  Front(const SparseMatrix& A, const HeatLevels& levels, const FrontOptions& options)
      : A_(A), levels_(levels), options_(options), w_(A.rows()) {}

  Index bands() const { return (levels_.count() + options_.band - 1) / options_.band; }
  WideVector take() && { return std::move(w_); }

  /// Band after band, zero beyond each. Factorizations in parallel, a group at a time so that
  /// memory is that of a few bands.
  void advance(const Context& context) {
    const Index group = 4 * static_cast<Index>(thread_count(context));
    context.need("heat", bytes_at_once(group));
    std::vector<std::optional<LdltFactor>> factors;
    for (Index k0 = 0; k0 < bands(); k0 += group) {
      const Index k1 = std::min(bands(), k0 + group);
      factors.clear();
      factors.resize(static_cast<std::size_t>(k1 - k0));
      parallel_for(context, k1 - k0, 1, [&](Index i, Index) {
        const Index level = (k0 + i) * options_.band;
        factors[static_cast<std::size_t>(i)].emplace(
            band_matrix(A_, levels_, levels_.start(level),
                        levels_.start(level + options_.band + options_.overlap)),
            FillOrder::minimum_degree);  // its memory is that of the whole group, asked for above
      });
      for (Index k = k0; k < k1; ++k) {
        const Index level = k * options_.band;
        // Nothing is known beyond a band yet, so w is 0 there.
        solve(*factors[static_cast<std::size_t>(k - k0)], level, level + options_.band,
              level + options_.band + options_.overlap, context);
        context.advance(1);
      }
    }
  }

  /// Solves anew around the levels where the front left an equation unmet, with what is known on
  /// both sides: heat that came from ahead, over steep faces. False where there is none.
  bool repair(std::span<const char> source, const Context& context) {
    const std::vector<Index> levels = unmet_levels(source, context);
    for (std::size_t i = 0; i < levels.size();) {
      std::size_t j = i + 1;
      while (j < levels.size() && levels[j] - levels[j - 1] <= options_.overlap) ++j;
      const Index first = std::max(Index{0}, levels[i] - options_.overlap);
      const Index last = std::min(levels_.count(), levels[j - 1] + options_.overlap + 1);
      solve(LdltFactor(band_matrix(A_, levels_, levels_.start(first), levels_.start(last)),
                       FillOrder::minimum_degree),
            first, last, last, context);
      i = j;
    }
    return !levels.empty();
  }

 private:
  /// The bands of a group, where that has the most unknowns: a front of some width crosses each, so
  /// that L has about as many nonzeros a column as the band has levels.
  Index bytes_at_once(Index group) const {
    Index most = 0;
    for (Index k0 = 0; k0 < bands(); k0 += group) {
      Index unknowns = 0;
      for (Index k = k0; k < std::min(bands(), k0 + group); ++k) {
        const Index level = k * options_.band;
        unknowns += levels_.start(level + options_.band + options_.overlap) - levels_.start(level);
      }
      most = std::max(most, unknowns);
    }
    return 12 * (options_.band + options_.overlap + 20) * most + 16 * A_.rows();
  }

  /// Solves on the levels [first, beyond), whose matrix has this factor, and keeps those before
  /// `last`.
  void solve(const LdltFactor& factor, Index first, Index last, Index beyond,
             const Context& context) {
    context.check();
    const Index begin = levels_.start(first), end = levels_.start(beyond);
    WideVector x(factor.size());
    const auto take = [&](Index level) {  // only neighbouring levels are coupled
      for (Index p = levels_.start(level); p < levels_.start(level + 1); ++p) {
        x.set(p - begin, arriving_heat(A_, levels_, w_, begin, end, p));
      }
    };
    take(first);
    if (beyond - 1 > first) take(std::min(beyond, levels_.count()) - 1);
    for (Index p = begin; p < levels_.start(1); ++p) x.add(p - begin, 1, 0);
    factor.solve_in_place(x);
    for (Index p = begin; p < levels_.start(last); ++p) w_.set(levels_.vertex(p), x[p - begin]);
  }

  std::vector<Index> unmet_levels(std::span<const char> source, const Context& context) const {
    std::vector<char> unmet(static_cast<std::size_t>(levels_.count()), 0);
    parallel_for(context, levels_.count(), 8, [&](Index first, Index last) {
      for (Index level = first; level < last; ++level) {
        for (Index p = levels_.start(level); p < levels_.start(level + 1); ++p) {
          const VertexId v = levels_.vertex(p);
          if (row_residual(A_, w_, v, source[static_cast<std::size_t>(v)] != 0) <= kUnmet) continue;
          unmet[static_cast<std::size_t>(level)] = 1;
          break;
        }
      }
    });
    std::vector<Index> result;
    for (Index level = 0; level < levels_.count(); ++level) {
      if (unmet[static_cast<std::size_t>(level)] != 0) result.push_back(level);
    }
    return result;
  }

  const SparseMatrix& A_;
  const HeatLevels& levels_;
  const FrontOptions& options_;
  WideVector w_;
};

std::vector<char> flags(Index n, std::span<const VertexId> sources) {
  std::vector<char> result(static_cast<std::size_t>(n), 0);
  for (const VertexId s : sources) result[static_cast<std::size_t>(s)] = 1;
  return result;
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
  const HeatLevels levels = heat_levels(A, sources, fixed);
  Front front(A, levels, options);
  HeatFront result;
  result.levels = levels.count();
  result.bands = front.bands();
  context.begin("heat", front.bands());
  front.advance(context);
  const std::vector<char> source = flags(A.rows(), sources);
  while (result.repairs < kRepairs && front.repair(source, context)) ++result.repairs;
  result.w = std::move(front).take();
  return result;
}

double componentwise_residual(const SparseMatrix& A, const WideVector& w,
                              std::span<const VertexId> sources, std::span<const char> fixed,
                              const Context& context) {
  const std::vector<char> source = flags(A.rows(), sources);
  return parallel_reduce(
      context, A.rows(), 4096, 0.,
      [&](Index first, Index last) {
        double worst = 0;
        for (Index v = first; v < last; ++v) {
          if (!fixed.empty() && fixed[static_cast<std::size_t>(v)] != 0) continue;
          const double residual = row_residual(A, w, v, source[static_cast<std::size_t>(v)] != 0);
          // Not max(): NaN must win, and stay.
          if (!std::isnan(worst) && !(residual <= worst)) worst = residual;
        }
        return worst;
      },
      [](double a, double b) { return a >= b || a != a ? a : b; });
}

}  // namespace dsc
