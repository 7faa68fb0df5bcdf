#include "libdsc/algorithms/regularise_energy.h"

#include "libdsc/base/parallel.h"

#include <Eigen/LU>

#include <algorithm>

namespace dsc {
namespace {

constexpr Index kGrain = 4096;

/// Turns counts a vertex, at v + 1, into the offset of its first entry.
void accumulate(std::vector<Index>& offsets) {
  for (std::size_t v = 1; v < offsets.size(); ++v) offsets[v] += offsets[v - 1];
}

}  // namespace

RegulariseEnergy::RegulariseEnergy(const FlatMesh& mesh, const RegulariseOptions& options,
                                   const Context& context)
    : mesh_(mesh), options_(options), context_(context) {
  find_corners();
  find_neighbours();
  invert_blocks();
}

void RegulariseEnergy::find_corners() {
  first_corner_.assign(static_cast<std::size_t>(mesh_.vertices()) + 1, 0);
  for (const VertexId v : mesh_.corners) ++first_corner_[static_cast<std::size_t>(v) + 1];
  accumulate(first_corner_);
  corners_.resize(mesh_.corners.size());
  std::vector<Index> next(first_corner_.begin(), first_corner_.end() - 1);
  double length = 0;
  for (Index f = 0; f < mesh_.faces(); ++f) {
    const auto ids = mesh_.face(f);
    const std::size_t n = ids.size();
    for (std::size_t i = 0; i < n; ++i) {
      const VertexId before = ids[i == 0 ? n - 1 : i - 1], after = ids[i + 1 == n ? 0 : i + 1];
      corners_[static_cast<std::size_t>(next[static_cast<std::size_t>(ids[i])]++)] = {before, after,
                                                                                      f};
      length += (mesh_.positions[after] - mesh_.positions[ids[i]]).norm();
    }
  }
  mean_edge_ = length / static_cast<double>(std::max<std::size_t>(corners_.size(), 1));
}

void RegulariseEnergy::find_neighbours() {
  const auto V = static_cast<std::size_t>(mesh_.vertices());
  // Each vertex' neighbours, once a face: ascending, so that equal ones come together.
  std::vector<VertexId> across(2 * corners_.size());
  first_neighbour_.assign(V + 1, 0);
  std::vector<char> boundary(first_neighbour_.size() - 1, 0);
  std::vector<std::pair<VertexId, bool>> distinct;  ///< the neighbour; is the edge on the boundary
  std::vector<std::pair<VertexId, bool>> all;
  for (std::size_t v = 0; v < V; ++v) {
    across.clear();
    for (Index c = first_corner_[v]; c < first_corner_[v + 1]; ++c) {
      across.push_back(corners_[static_cast<std::size_t>(c)].before);
      across.push_back(corners_[static_cast<std::size_t>(c)].after);
    }
    std::sort(across.begin(), across.end());
    distinct.clear();
    for (std::size_t i = 0; i < across.size();) {
      std::size_t j = i;
      while (j < across.size() && across[j] == across[i]) ++j;
      distinct.emplace_back(across[i], j == i + 1);  // one face alone has the edge
      if (j == i + 1) boundary[v] = 1;
      i = j;
    }
    all.insert(all.end(), distinct.begin(), distinct.end());
    first_neighbour_[v + 1] = static_cast<Index>(all.size());
  }
  // The vertices that b̂ is the mean of: on the boundary, those along it.
  std::vector<double> weight(V, 0);
  const auto counts = [&](std::size_t v, bool along_boundary) {
    return boundary[v] == 0 || along_boundary;
  };
  for (std::size_t v = 0; v < V; ++v) {
    for (Index k = first_neighbour_[v]; k < first_neighbour_[v + 1]; ++k) {
      if (counts(v, all[static_cast<std::size_t>(k)].second)) weight[v] += 1;
    }
    if (weight[v] > 0) weight[v] = 1 / weight[v];
  }
  neighbours_.resize(all.size());
  for (std::size_t v = 0; v < V; ++v) {
    for (Index k = first_neighbour_[v]; k < first_neighbour_[v + 1]; ++k) {
      const auto [other, along] = all[static_cast<std::size_t>(k)];
      const auto w = static_cast<std::size_t>(other);
      neighbours_[static_cast<std::size_t>(k)] = {other, counts(v, along) ? weight[v] : 0.,
                                                  counts(w, along) ? weight[w] : 0.};
    }
  }
}

void RegulariseEnergy::invert_blocks() {
  inverse_blocks_.resize(static_cast<std::size_t>(mesh_.vertices()));
  parallel_for(context_, mesh_.vertices(), kGrain, [&](Index first, Index last) {
    for (Index v = first; v < last; ++v) {
      const auto at = static_cast<std::size_t>(v);
      double even = first_neighbour_[at + 1] > first_neighbour_[at] ? 1. : 0.;
      for (Index k = first_neighbour_[at]; k < first_neighbour_[at + 1]; ++k) {
        const double there = neighbours_[static_cast<std::size_t>(k)].there;
        even += there * there;
      }
      Mat3 block = (options_.alpha + options_.gamma * even) * Mat3::Identity();
      for (Index c = first_corner_[at]; c < first_corner_[at + 1]; ++c) {
        const Vec3 u = mesh_.normals[corners_[static_cast<std::size_t>(c)].face];
        block += 2. * options_.beta * u * u.transpose();
      }
      inverse_blocks_[at] = block.inverse();
    }
  });
}

Vec3 RegulariseEnergy::unevenness(const Eigen::VectorXd& x, Index v) const {
  const auto at = static_cast<std::size_t>(v);
  if (first_neighbour_[at] == first_neighbour_[at + 1]) return Vec3::Zero();
  Vec3 sum = x.segment<3>(3 * v);
  for (Index k = first_neighbour_[at]; k < first_neighbour_[at + 1]; ++k) {
    const Neighbour& n = neighbours_[static_cast<std::size_t>(k)];
    sum -= n.here * x.segment<3>(3 * Index{n.vertex});
  }
  return sum;
}

void RegulariseEnergy::apply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const {
  Eigen::VectorXd uneven(x.size());
  parallel_for(context_, mesh_.vertices(), kGrain, [&](Index first, Index last) {
    for (Index v = first; v < last; ++v) uneven.segment<3>(3 * v) = unevenness(x, v);
  });
  parallel_for(context_, mesh_.vertices(), kGrain, [&](Index first, Index last) {
    for (Index v = first; v < last; ++v) {
      const auto at = static_cast<std::size_t>(v);
      const Vec3 here = x.segment<3>(3 * v);
      Vec3 even = uneven.segment<3>(3 * v);
      for (Index k = first_neighbour_[at]; k < first_neighbour_[at + 1]; ++k) {
        const Neighbour& n = neighbours_[static_cast<std::size_t>(k)];
        even -= n.there * uneven.segment<3>(3 * Index{n.vertex});
      }
      Vec3 aligned = Vec3::Zero();
      for (Index c = first_corner_[at]; c < first_corner_[at + 1]; ++c) {
        const Corner& corner = corners_[static_cast<std::size_t>(c)];
        const Vec3 u = mesh_.normals[corner.face];
        aligned += u * u.dot((here - x.segment<3>(3 * Index{corner.before})) +
                             (here - x.segment<3>(3 * Index{corner.after})));
      }
      y.segment<3>(3 * v) = options_.alpha * here + options_.beta * aligned + options_.gamma * even;
    }
  });
}

void RegulariseEnergy::precondition(const Eigen::VectorXd& r, Eigen::VectorXd& z) const {
  parallel_for(context_, mesh_.vertices(), kGrain, [&](Index first, Index last) {
    for (Index v = first; v < last; ++v) {
      z.segment<3>(3 * v) = inverse_blocks_[static_cast<std::size_t>(v)] * r.segment<3>(3 * v);
    }
  });
}

}  // namespace dsc
