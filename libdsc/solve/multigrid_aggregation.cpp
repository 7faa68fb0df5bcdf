#include "libdsc/solve/multigrid_aggregation.h"

#include <cmath>

namespace dsc {
namespace {

constexpr double kDominance = 5.0;

/// Decides which couplings are strong; symmetric in i and j.
class Strength {
 public:
  Strength(RowsView<double> a, double threshold, const Context& context) : a_(a), bound_(a.rows) {
    parallel_for(context, a.rows, kRowGrain, [&](Index first, Index last) {
      for (Index i = first; i < last; ++i) {
        double most = 0;
        for (int k = a.start[i]; k < a.start[i + 1]; ++k) {
          if (a.column[k] != i) most = std::max(most, -a.value[k]);
        }
        bound_[i] = threshold * most;
      }
    });
  }

  bool operator()(Index i, int k) const {
    const int j = a_.column[k];
    return j != i && a_.value[k] < 0 && -a_.value[k] >= std::min(bound_[i], bound_[j]);
  }

 private:
  RowsView<double> a_;
  std::vector<double> bound_;
};

constexpr int kUnassigned = -2;
constexpr int kSkipped = -1;

bool needs_no_coarse_space(RowsView<double> a, double diagonal, Index i) {
  double couplings = 0, negative = 0;
  for (int k = a.start[i]; k < a.start[i + 1]; ++k) {
    if (a.column[k] == i) continue;
    couplings += std::abs(a.value[k]);
    negative -= std::min(0.0, a.value[k]);
  }
  return negative == 0 || diagonal >= kDominance * couplings;
}

}  // namespace

Aggregates aggregate(RowsView<double> a, const std::vector<double>& diagonal, double strength,
                     const Context& context) {
  const Strength strong(a, strength, context);
  Aggregates result;
  std::vector<int>& of = result.of;
  of.resize(a.rows);
  parallel_for(context, a.rows, kRowGrain, [&](Index first, Index last) {
    for (Index i = first; i < last; ++i) {
      of[i] = needs_no_coarse_space(a, diagonal[i], i) ? kSkipped : kUnassigned;
    }
  });

  // A row none of whose strong neighbours is taken becomes the root of an aggregate.
  for (Index i = 0; i < a.rows; ++i) {
    if (of[i] != kUnassigned) continue;
    bool free = true;
    for (int k = a.start[i]; free && k < a.start[i + 1]; ++k)
      free = of[a.column[k]] < 0 || !strong(i, k);
    if (!free) continue;
    const int root = static_cast<int>(result.count++);
    of[i] = root;
    for (int k = a.start[i]; k < a.start[i + 1]; ++k) {
      if (of[a.column[k]] == kUnassigned && strong(i, k)) of[a.column[k]] = root;
    }
  }

  // Each row left has a strong neighbour in an aggregate: it joins that of the strongest. The
  // roots' choice is kept in `taken`, so aggregates grow by one ring only, in any order of rows.
  const std::vector<int> taken = of;
  parallel_for(context, a.rows, kRowGrain, [&](Index first, Index last) {
    for (Index i = first; i < last; ++i) {
      if (taken[i] != kUnassigned) continue;
      double strongest = 0;
      for (int k = a.start[i]; k < a.start[i + 1]; ++k) {
        if (taken[a.column[k]] >= 0 && strong(i, k) && -a.value[k] > strongest) {
          strongest = -a.value[k];
          of[i] = taken[a.column[k]];
        }
      }
    }
  });
  return result;
}

SparseRows<float> smoothed_prolongation(RowsView<double> a, const Aggregates& aggregates,
                                        double strength, double weight, const Context& context) {
  const Strength strong(a, strength, context);
  const std::vector<int>& of = aggregates.of;
  return build_rows<float>(context, a.rows, aggregates.count, [&](Index i, RowSum& row) {
    if (of[i] < 0) return;
    double sum = 0;
    for (int k = a.start[i]; k < a.start[i + 1]; ++k) {
      if (of[a.column[k]] >= 0 && strong(i, k)) sum -= a.value[k];
    }
    if (sum == 0) return row.add(of[i], 1.0);
    row.add(of[i], 1.0 - weight);
    for (int k = a.start[i]; k < a.start[i + 1]; ++k) {
      if (of[a.column[k]] >= 0 && strong(i, k))
        row.add(of[a.column[k]], -weight * a.value[k] / sum);
    }
  });
}

SparseRows<double> galerkin_product(RowsView<double> a, const SparseRows<float>& prolongation,
                                    const SparseRows<float>& transposed, const Context& context) {
  const RowsView<float> p = prolongation.view();
  const RowsView<float> pt = transposed.view();
  return build_rows<double>(context, pt.rows, pt.rows, [&](Index coarse, RowSum& row) {
    for (int t = pt.start[coarse]; t < pt.start[coarse + 1]; ++t) {
      const int i = pt.column[t];
      for (int k = a.start[i]; k < a.start[i + 1]; ++k) {
        const double weight = pt.value[t] * a.value[k];
        const int j = a.column[k];
        for (int c = p.start[j]; c < p.start[j + 1]; ++c) row.add(p.column[c], weight * p.value[c]);
      }
    }
  });
}

}  // namespace dsc
