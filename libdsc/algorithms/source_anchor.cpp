#include "libdsc/algorithms/source_anchor.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace dsc {
namespace {

constexpr int kPasses = 8;

bool hotter(const WideVector& w, Index a, Index b) {
  const double ma = w.mantissa(a), mb = w.mantissa(b);
  if (ma <= 0 || mb <= 0) return std::max(ma, 0.) > std::max(mb, 0.);
  return w.exponent(a) != w.exponent(b) ? w.exponent(a) > w.exponent(b) : ma > mb;
}

/// The mean of `shift` over the neighbours of v that have one, by the heat that they send; by
/// number where that is nothing. NaN where no neighbour has one.
double arriving(const SparseMatrix& A, const WideVector& w, const Eigen::VectorXd& shift,
                VertexId v) {
  double sum = 0, weight = 0, plain = 0, count = 0;
  for (SparseMatrix::InnerIterator it(A, v); it; ++it) {
    const double s = shift[it.row()];
    if (s != s || it.row() == v) continue;
    const double heat = std::max(0., -it.value() * w.relative_to(it.row(), w.exponent(v)));
    sum += heat * s;
    weight += heat;
    plain += s;
    count += 1;
  }
  return weight > 0 && weight < std::numeric_limits<double>::infinity() ? sum / weight
                                                                        : plain / count;
}

}  // namespace

void anchor_sources(Eigen::VectorXd& phi, const SparseMatrix& A, const WideVector& w,
                    std::span<const VertexId> sources) {
  if (sources.size() == 1) {
    phi.array() -= double(phi[sources[0]]);
    return;
  }
  // Hottest first: every vertex then finds its hotter neighbours done, and only them.
  std::vector<VertexId> hottest_first;
  for (Index v = 0; v < phi.size(); ++v) {
    if (w.mantissa(v) != 0) hottest_first.push_back(static_cast<VertexId>(v));
  }
  std::sort(hottest_first.begin(), hottest_first.end(),
            [&](VertexId a, VertexId b) { return hotter(w, a, b) || (!hotter(w, b, a) && a < b); });
  Eigen::VectorXd shift =
      Eigen::VectorXd::Constant(phi.size(), std::numeric_limits<double>::quiet_NaN());
  for (const VertexId s : sources) shift[s] = phi[s];
  // A local maximum of w that is no source can only come from rounding or from positive couplings
  // in A: it waits until a neighbour has a shift.
  std::vector<VertexId> order = hottest_first;
  while (!order.empty()) {
    std::vector<VertexId> waiting;
    for (const VertexId v : order) {
      if (shift[v] == shift[v]) continue;
      shift[v] = arriving(A, w, shift, v);
      if (shift[v] != shift[v]) waiting.push_back(v);
    }
    if (waiting.size() == order.size()) break;
    order.swap(waiting);
  }
  // Cold neighbours send some heat too. A few more passes bring their share in, so that rounding,
  // which decides who of two equals is the hotter, decides nothing else.
  std::vector<char> pinned(static_cast<std::size_t>(phi.size()), 0);
  for (const VertexId s : sources) pinned[static_cast<std::size_t>(s)] = 1;
  for (int pass = 0; pass < kPasses; ++pass) {
    for (const VertexId v : hottest_first) {
      if (pinned[static_cast<std::size_t>(v)] == 0) shift[v] = arriving(A, w, shift, v);
    }
  }
  for (Index v = 0; v < phi.size(); ++v) {
    if (shift[v] == shift[v]) phi[v] -= shift[v];
  }
}

}  // namespace dsc
