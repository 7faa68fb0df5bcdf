#include "libdsc/solve/components.h"

#include "libdsc/base/error.h"

#include <cmath>
#include <string>

namespace dsc {

Components connected_components(const FlatMesh& mesh) {
  const auto n = static_cast<std::size_t>(mesh.vertices());
  // Union-find; the root of a set is its lowest id.
  std::vector<VertexId> parent(n);
  for (std::size_t v = 0; v < n; ++v) parent[v] = static_cast<VertexId>(v);
  const auto root = [&](VertexId v) {
    auto i = static_cast<std::size_t>(v);
    while (parent[i] != static_cast<VertexId>(i)) {
      parent[i] = parent[static_cast<std::size_t>(parent[i])];  // halve the path
      i = static_cast<std::size_t>(parent[i]);
    }
    return static_cast<VertexId>(i);
  };
  for (Index f = 0; f < mesh.faces(); ++f) {
    const auto face = mesh.face(f);
    for (const VertexId v : face) {
      if (v < 0 || static_cast<std::size_t>(v) >= n) {
        throw InputError("face " + std::to_string(f) + " has the corner " + std::to_string(v) +
                         ", but there are " + std::to_string(n) + " vertices");
      }
    }
    for (std::size_t i = 1; i < face.size(); ++i) {
      const VertexId a = root(face[i - 1]);
      const VertexId b = root(face[i]);
      if (a < b) parent[static_cast<std::size_t>(b)] = a;
      if (b < a) parent[static_cast<std::size_t>(a)] = b;
    }
  }
  Components components;
  components.of_vertex.resize(n);
  for (std::size_t v = 0; v < n; ++v) {  // a root comes before the rest of its set
    const VertexId r = root(static_cast<VertexId>(v));
    if (static_cast<std::size_t>(r) == v) {
      components.of_vertex[v] = static_cast<VertexId>(components.lowest.size());
      components.lowest.push_back(r);
    } else {
      components.of_vertex[v] = components.of_vertex[static_cast<std::size_t>(r)];
    }
  }
  return components;
}

namespace {

/// Of the size of the largest entry; 1 where all are 0.
double power_of_two_over(const Eigen::VectorXd& x) {
  const double largest = x.size() == 0 ? 0. : x.cwiseAbs().maxCoeff();
  return std::isnormal(largest) ? std::ldexp(1., std::ilogb(largest)) : 1.;
}

}  // namespace

Eigen::VectorXd component_means(const Components& components, const Eigen::VectorXd& weights,
                                const Eigen::VectorXd& x) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(components.count());
  Eigen::VectorXd total = Eigen::VectorXd::Zero(components.count());
  // Products of large weights and values would be infinite; powers of two change no digit.
  const double w_unit = weights.size() != 0 ? power_of_two_over(weights) : 1;
  const double x_unit = power_of_two_over(x);
  for (Index v = 0; v < x.size(); ++v) {
    const VertexId c = components.of_vertex[static_cast<std::size_t>(v)];
    const double w = weights.size() != 0 ? weights[v] / w_unit : 1;
    sum[c] += w * (x[v] / x_unit);
    total[c] += w;
  }
  return x_unit * sum.cwiseQuotient(total);
}

}  // namespace dsc
