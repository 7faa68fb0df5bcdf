#include "libdsc/calculus/heat_kernel_laplacian.h"

#include "libdsc/base/error.h"
#include "libdsc/base/parallel.h"
#include "libdsc/calculus/mesh_checks.h"
#include "libdsc/calculus/polygon_kernel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

namespace dsc {
namespace {

constexpr double kCutoff = 5.;  // standard deviations √(2t) of the kernel
constexpr Index kCellsPerCutoff = 4;
constexpr Index kMostCells = Index{1} << 22;
constexpr Index kBatch = 128;  // terms whose exponentials are taken together

/// Centre and projected area of every face.
struct Faces {
  Eigen::Matrix3Xd centres;
  Eigen::VectorXd areas;
  Index clamped = 0;
};

Faces faces_of(const FlatMesh& mesh, const CalculusOptions& options, const Context& context) {
  check_mesh(mesh, options);
  Faces faces{Eigen::Matrix3Xd(3, mesh.faces()), Eigen::VectorXd(mesh.faces()), 0};
  const auto some = [&](Index first, Index last) {
    PolygonKernel kernel(mesh, options);
    Index clamped = 0;
    for (Index f = first; f < last; ++f) {
      kernel.load(f);
      Vec3 centre = Vec3::Zero();
      for (const VertexId v : mesh.face(f)) centre += mesh.positions[v];
      faces.centres.col(f) = centre / static_cast<double>(mesh.face(f).size());
      faces.areas[f] = kernel.area();
      if (kernel.clamped()) ++clamped;
    }
    return clamped;
  };
  faces.clamped = parallel_reduce(context, mesh.faces(), 4096, Index{0}, some,
                                  [](Index a, Index b) { return a + b; });
  return faces;
}

}  // namespace

HeatKernelLaplacian::HeatKernelLaplacian(const FlatMesh& mesh, double time,
                                         const CalculusOptions& options, const Context& context)
    : time_(time) {
  if (!(time > 0) || !std::isfinite(time)) {
    throw UsageError("heat kernel: the time must be positive and finite, not " +
                     std::to_string(time));
  }
  const Faces faces = faces_of(mesh, options, context);
  clamped_faces_ = faces.clamped;
  cutoff_ = kCutoff * std::sqrt(2. * time);

  const Index n = faces.centres.cols();
  for (Index f = 0; f < n; ++f) box_.extend(Vec3(faces.centres.col(f)));
  if (n == 0) box_.extend(Vec3::Zero());
  for (int axis = 0; axis < 3; ++axis) {
    const double wanted = box_.sizes()[axis] * static_cast<double>(kCellsPerCutoff) / cutoff_;
    const auto most = static_cast<double>(Index{1} << 20);
    cells_[static_cast<std::size_t>(axis)] = static_cast<Index>(std::min(wanted, most)) + 1;
  }
  // A short time on a large surface: fewer cells, more candidates in each.
  while (cells_[0] * cells_[1] * cells_[2] > kMostCells) {
    Index& widest = *std::max_element(cells_.begin(), cells_.end());
    widest = (widest + 1) / 2;
  }
  for (int axis = 0; axis < 3; ++axis) {
    const double extent = std::max(box_.sizes()[axis], cutoff_ * 1e-3);
    inverse_cell_[axis] =
        static_cast<double>(cells_[static_cast<std::size_t>(axis)]) / (extent * (1. + 1e-12));
  }

  // Counting sort.
  const auto cell_of = [&](Index f) {
    Index cell = 0;
    for (int axis = 2; axis >= 0; --axis) {
      const Index count = cells_[static_cast<std::size_t>(axis)];
      const double place = (faces.centres(axis, f) - box_.min()[axis]) * inverse_cell_[axis];
      cell = cell * count + std::min(static_cast<Index>(place), count - 1);
    }
    return cell;
  };
  first_.assign(static_cast<std::size_t>(cells_[0] * cells_[1] * cells_[2]) + 1, 0);
  for (Index f = 0; f < n; ++f) ++first_[static_cast<std::size_t>(cell_of(f)) + 1];
  for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
  std::vector<Index> next(first_.begin(), first_.end() - 1);
  const auto count = static_cast<std::size_t>(n);
  face_.resize(count);
  for (auto* values : {&x_, &y_, &z_, &mass_}) values->resize(count);
  for (Index f = 0; f < n; ++f) {
    const auto at = static_cast<std::size_t>(next[static_cast<std::size_t>(cell_of(f))]++);
    face_[at] = f;
    x_[at] = faces.centres(0, f);
    y_[at] = faces.centres(1, f);
    z_[at] = faces.centres(2, f);
    mass_[at] = faces.areas[f];
  }
}

double HeatKernelLaplacian::sum_at(Index s, const double* values) const {
  const auto at = static_cast<std::size_t>(s);
  const Vec3 p(x_[at], y_[at], z_[at]);
  const double own = values[at];
  const double reach = cutoff_ * cutoff_;
  const double rate = -0.25 / time_;
  Index3 low{};
  Index3 high{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const auto cell = [&](double offset) {
      const double place = (p[axis] + offset - box_.min()[axis]) * inverse_cell_[axis];
      return static_cast<Index>(std::clamp(place, 0., static_cast<double>(cells_[a] - 1)));
    };
    low[a] = cell(-cutoff_);
    high[a] = cell(cutoff_);
  }
  double sum = 0.;
  std::array<double, kBatch> squares;
  std::array<double, kBatch> kernel;
  for (Index cz = low[2]; cz <= high[2]; ++cz) {
    for (Index cy = low[1]; cy <= high[1]; ++cy) {
      const Index row = (cz * cells_[1] + cy) * cells_[0];
      Index r = first_[static_cast<std::size_t>(row + low[0])];
      const Index end = first_[static_cast<std::size_t>(row + high[0]) + 1];
      for (; r < end; r += kBatch) {
        const auto m = static_cast<std::size_t>(std::min(kBatch, end - r));
        const auto begin = static_cast<std::size_t>(r);
        for (std::size_t i = 0; i < m; ++i) {
          const double dx = x_[begin + i] - p[0];
          const double dy = y_[begin + i] - p[1];
          const double dz = z_[begin + i] - p[2];
          squares[i] = dx * dx + dy * dy + dz * dz;
        }
        const auto length = static_cast<Index>(m);
        Eigen::Map<Eigen::ArrayXd>(kernel.data(), length) =
            (Eigen::Map<const Eigen::ArrayXd>(squares.data(), length) * rate).exp();
        for (std::size_t i = 0; i < m; ++i) {
          const double term = kernel[i] * mass_[begin + i] * (values[begin + i] - own);
          sum += squares[i] <= reach ? term : 0.;
        }
      }
    }
  }
  return sum;
}

Eigen::VectorXd HeatKernelLaplacian::apply(const Eigen::VectorXd& f, const Context& context) const {
  if (f.size() != faces()) {
    throw UsageError("heat kernel: the function has " + std::to_string(f.size()) +
                     " values, the mesh " + std::to_string(faces()) + " faces");
  }
  std::vector<double> values(face_.size());
  for (std::size_t s = 0; s < values.size(); ++s) {
    values[s] = f[face_[s]];
    if (!std::isfinite(values[s])) {
      throw InputError("heat kernel: the function is not finite on face " +
                       std::to_string(face_[s]));
    }
  }
  const double factor = 1. / (4. * std::numbers::pi * time_ * time_);
  Eigen::VectorXd result(f.size());
  context.begin("heat kernel", faces());
  parallel_for(context, faces(), 256, [&](Index first, Index last) {
    for (Index s = first; s < last; ++s) {
      result[face_[static_cast<std::size_t>(s)]] = factor * sum_at(s, values.data());
    }
    context.advance(last - first);
  });
  return result;
}

Eigen::VectorXd HeatKernelLaplacian::masses() const {
  Eigen::VectorXd result(faces());
  for (std::size_t s = 0; s < face_.size(); ++s) result[face_[s]] = mass_[s];
  return result;
}

}  // namespace dsc
