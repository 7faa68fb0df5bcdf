#include "libdsc/algorithms/heat_directions.h"

#include "libdsc/base/error.h"
#include "libdsc/base/parallel.h"
#include "libdsc/calculus/field_operators.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

namespace dsc {
namespace {

constexpr double kFlat = 1e-5;  // of |G w| times the face's size, where w's largest entry is 1

/// The faces [first, last) of a mesh with corners of their own: a function on it is free to be
/// scaled face by face.
class Exploded {
 public:
  Exploded(const FlatMesh& mesh, Index first, Index last) {
    const Index c0 = mesh.first_corner(first);
    const Index c1 = mesh.first_corner(last);
    positions_.resize(3, c1 - c0);
    for (Index c = c0; c < c1; ++c) {
      const VertexId v = mesh.corners[static_cast<std::size_t>(c)];
      if (v < 0 || v >= mesh.vertices()) {
        throw InputError("a face has the corner " + std::to_string(v) + ", but there are " +
                         std::to_string(mesh.vertices()) + " vertices");
      }
      positions_.col(c - c0) = mesh.positions[v];
    }
    corners_.resize(static_cast<std::size_t>(c1 - c0));
    std::iota(corners_.begin(), corners_.end(), 0);
    flat_.positions = {positions_.data(), c1 - c0};
    flat_.corners = corners_;
    if (!mesh.offsets.empty()) {
      for (Index f = first; f <= last; ++f) offsets_.push_back(mesh.first_corner(f) - c0);
      flat_.offsets = offsets_;
    }
    if (mesh.has_normals()) flat_.normals = {mesh.normals.data + 3 * first, last - first};
    if (mesh.is_digital()) {
      flat_.surfels = mesh.surfels.subspan(static_cast<std::size_t>(first),
                                           static_cast<std::size_t>(last - first));
    }
    flat_.spacing = mesh.spacing;
  }
  Exploded(const Exploded&) = delete;
  Exploded& operator=(const Exploded&) = delete;

  const FlatMesh& flat() const { return flat_; }
  /// The length of face f's first edge and a half turn: the size that gradients are judged by.
  double size(Index f) const {
    const Index c = flat_.first_corner(f);
    return (positions_.col(c) - positions_.col(c + 1)).norm() +
           (positions_.col(c) - positions_.col(c + 2)).norm();
  }

 private:
  Eigen::Matrix3Xd positions_;
  std::vector<VertexId> corners_;
  std::vector<Index> offsets_;
  FlatMesh flat_;
};

}  // namespace

HeatDirections heat_directions(const FlatMesh& mesh, const WideVector& w, double t,
                               const CalculusOptions& options, const Context& context) {
  if (w.size() != mesh.vertices()) {
    throw UsageError("heat: there are " + std::to_string(w.size()) + " values for " +
                     std::to_string(mesh.vertices()) + " vertices");
  }
  HeatDirections result;
  result.d.resize(3, mesh.faces());
  struct Counts {
    Index flat = 0;
    Index cold = 0;
    Index negative = 0;
  };
  const Context inner{1, nullptr};
  const auto block = [&](Index first, Index last) {
    const Exploded part(mesh, first, last);
    const FlatMesh& flat = part.flat();
    Eigen::VectorXd scaled(flat.vertices());
    Counts counts;
    const Index c0 = mesh.first_corner(first);
    for (Index f = 0; f < last - first; ++f) {
      const auto face = mesh.face(first + f);
      const Index c = mesh.first_corner(first + f) - c0;
      bool cold = true, negative = false;
      std::int32_t top = 0;
      for (const VertexId v : face) {
        if (w.mantissa(v) == 0) continue;
        top = cold ? w.exponent(v) : std::max(top, w.exponent(v));
        cold = false;
        negative = negative || w.mantissa(v) < 0;
      }
      auto values = scaled.segment(c, static_cast<Index>(face.size()));
      for (std::size_t i = 0; i < face.size(); ++i) {
        // Positive couplings at steep faces can send heat of the wrong sign into a whole sector,
        // where it decays as that of the right one does.
        values[static_cast<Index>(i)] = std::abs(w.relative_to(face[i], top));
      }
      counts.cold += cold ? 1 : 0;
      counts.negative += negative ? 1 : 0;
      if (!cold) values /= values.cwiseAbs().maxCoeff();
    }
    auto d = result.d.middleCols(first, last - first);
    d = face_gradients(flat, scaled, options, inner);
    for (Index f = 0; f < last - first; ++f) {
      // Heat falls by about a part size / sqrt(t) on a face, size^2 / t once it has spread out.
      const double size = part.size(f);
      const double length = d.col(f).norm();
      d.col(f) /= -std::hypot(length, kFlat / size * std::min(1., size * size / t));
      if (!(d.col(f).squaredNorm() > 0.25)) ++counts.flat;
    }
    counts.flat -= counts.cold;
    return counts;
  };
  const Counts total =
      parallel_reduce(context, mesh.faces(), 4096, Counts{}, block, [](Counts a, Counts b) {
        return Counts{a.flat + b.flat, a.cold + b.cold, a.negative + b.negative};
      });
  result.flat_faces = total.flat;
  result.cold_faces = total.cold;
  result.negative_faces = total.negative;
  return result;
}

}  // namespace dsc
