#include "libdsc/solve/matrix_components.h"

#include <cmath>
#include <string>

namespace dsc {
namespace {

constexpr double kEdgeTolerance = 1e-14;
constexpr double kRowSumTolerance = 1e-12;

void label_component(RowsView<double> a, const std::vector<double>& diagonal, int seed, int label,
                     std::vector<int>& labels, std::vector<int>& queue) {
  queue.assign(1, seed);
  labels[seed] = label;
  for (std::size_t head = 0; head < queue.size(); ++head) {
    const int i = queue[head];
    for (int k = a.start[i]; k < a.start[i + 1]; ++k) {
      const auto j = static_cast<std::size_t>(a.column[k]);
      if (labels[j] >= 0) continue;
      const double scale = kEdgeTolerance * kEdgeTolerance * diagonal[i] * diagonal[j];
      if (a.value[k] * a.value[k] <= scale) continue;
      labels[j] = label;
      queue.push_back(static_cast<int>(j));
    }
  }
}

/// Sums of all entries and of all absolute entries in the rows of a component.
struct EntrySums {
  double sum = 0.0;
  double absolute = 0.0;
};

}  // namespace

MatrixComponents matrix_components(RowsView<double> a, const Context& context) {
  std::vector<double> diagonal(a.rows, 0.0);
  for (Index i = 0; i < a.rows; ++i) {
    for (int k = a.start[i]; k < a.start[i + 1]; ++k) {
      if (a.column[k] == i) diagonal[i] = a.value[k];
    }
  }
  MatrixComponents result;
  result.label.assign(a.rows, -1);
  std::vector<int> queue;
  for (Index i = 0; i < a.rows; ++i) {
    if (result.label[i] >= 0) continue;
    context.check();
    label_component(a, diagonal, static_cast<int>(i), static_cast<int>(result.count()),
                    result.label, queue);
    result.size.push_back(static_cast<Index>(queue.size()));
  }
  result.singular.assign(result.size.size(), 1);
  std::vector<EntrySums> entries(result.size.size());
  for (Index i = 0; i < a.rows; ++i) {
    double sum = 0, absolute = 0;
    for (int k = a.start[i]; k < a.start[i + 1]; ++k) {
      sum += a.value[k];
      absolute += std::abs(a.value[k]);
    }
    const int c = result.label[i];
    entries[c].sum += sum;
    entries[c].absolute += absolute;
    if (std::abs(sum) > kRowSumTolerance * absolute) result.singular[c] = 0;
  }
  for (std::size_t c = 0; c < entries.size(); ++c) {
    if (entries[c].sum < -kRowSumTolerance * entries[c].absolute) {
      throw SolverError("the matrix is indefinite: the entries of connected component " +
                        std::to_string(c) + " (" + std::to_string(result.size[c]) +
                        " unknowns) sum to " + std::to_string(entries[c].sum) +
                        "; pass -L or M - tL with t > 0");
    }
    result.singular_count += result.singular[c];
  }
  return result;
}

std::vector<double> singular_means(const MatrixComponents& components, const double* x,
                                   const Context& context) {
  std::vector<double> means(components.size.size(), 0.0);
  if (components.singular_count == 0) return means;
  // One component is the common case and worth the threads; several are summed in row order.
  const auto rows = static_cast<Index>(components.label.size());
  if (components.count() == 1) {
    means[0] = parallel_reduce(
        context, rows, kRowGrain, 0.0,
        [&](Index first, Index last) {
          double sum = 0;
          for (Index i = first; i < last; ++i) sum += x[i];
          return sum;
        },
        [](double s, double t) { return s + t; });
  } else {
    for (Index i = 0; i < rows; ++i) means[components.label[i]] += x[i];
  }
  for (std::size_t c = 0; c < means.size(); ++c) {
    means[c] = components.singular[c] ? means[c] / static_cast<double>(components.size[c]) : 0.0;
  }
  return means;
}

void shift_components(const MatrixComponents& components, const std::vector<double>& shift,
                      double* x, const Context& context) {
  if (components.singular_count == 0) return;
  parallel_for(context, static_cast<Index>(components.label.size()), kRowGrain,
               [&](Index first, Index last) {
                 for (Index i = first; i < last; ++i) x[i] += shift[components.label[i]];
               });
}

}  // namespace dsc
