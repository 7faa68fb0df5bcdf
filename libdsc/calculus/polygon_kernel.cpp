#include "libdsc/calculus/polygon_kernel.h"

#include "libdsc/calculus/embedding.h"
#include "libdsc/calculus/mesh_checks.h"

namespace dsc {

PolygonKernel::PolygonKernel(const FlatMesh& mesh, const CalculusOptions& options)
    : mesh_(mesh), options_(options), shapes_(surfel_shapes(mesh.spacing)) {}

void PolygonKernel::load(Index face) {
  const auto ids = mesh_.face(face);
  const std::size_t n = ids.size();
  corners_.resize(n);
  edges_.resize(n);
  for (const VertexId v : ids) check_vertex(mesh_, face, v);

  // Relative to the first corner, lest a far origin cost the digits of a small face.
  const Vec3 origin = mesh_.positions[ids[0]];
  mean_.setZero();
  for (std::size_t i = 0; i < n; ++i) {
    corners_[i] = mesh_.positions[ids[i]] - origin;
    mean_ += corners_[i];
  }
  mean_ /= static_cast<double>(n);
  Vec3 vector_area = Vec3::Zero();
  double scale = 0.;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3& next = corners_[i + 1 == n ? 0 : i + 1];
    edges_[i] = next - corners_[i];
    vector_area += 0.5 * corners_[i].cross(next);
    scale += edges_[i].squaredNorm();
  }
  area_ = vector_area.norm();
  if (!is_area(area_, scale)) refuse_area(mesh_, face);
  u_ = vector_area / area_;
  clamped_ = false;
  if (mesh_.has_normals()) {
    const Vec3 estimate = mesh_.normals[face];
    if (!is_unit(estimate)) refuse_normal(mesh_, face);
    const Embedding embedding = embed(estimate, u_, options_.min_cosine);
    u_ = embedding.u;
    area_ *= embedding.cosine;
    clamped_ = embedding.clamped;
  }

  lambda_ = options_.stabilization == Stabilization::mercat ? 0. : options_.lambda;
  if (mesh_.is_digital()) {
    const int direction = mesh_.surfels[static_cast<std::size_t>(face)].direction;
    if (direction < 0 || direction > 5) refuse_direction(mesh_, face);
    const SurfelOperators surfel(shapes_[static_cast<std::size_t>(direction)], u_, 0.);
    lambda_ = SurfelLambda(options_)(surfel.laplacian().s);
  }
}

Vec3 PolygonKernel::sharp(Index i) const {
  const auto at = static_cast<std::size_t>(i);
  const Vec3 midpoint = corners_[at] + 0.5 * edges_[at];
  return u_.cross(midpoint - mean_) / area_;
}

void PolygonKernel::laplacian(double* L) {
  const Index n = corners();
  columns_.resize(edges_.size());
  products_.resize(edges_.size());
  const auto g = [&](Index j) -> const Vec3& { return columns_[static_cast<std::size_t>(j)]; };
  const auto z = [&](Index j) -> const Vec3& { return products_[static_cast<std::size_t>(j)]; };
  for (Index j = 0; j < n; ++j) columns_[static_cast<std::size_t>(j)] = gradient(j);
  const auto pd = [&](Index k, Index j) {
    const double d = k == j ? -1. : ((k + 1 == n ? 0 : k + 1) == j ? 1. : 0.);
    return d - edge(k).dot(g(j));
  };
  // (PD)ᵀPD = Dᵀ(PD) − Gᵀ z with z = Eᵀ PD: n² products instead of n³.
  for (Index j = 0; j < n; ++j) {
    Vec3 sum = Vec3::Zero();
    for (Index k = 0; k < n; ++k) sum += pd(k, j) * edge(k);
    products_[static_cast<std::size_t>(j)] = sum;
  }
  for (Index i = 0; i < n; ++i) {
    const Index before = i == 0 ? n - 1 : i - 1;
    for (Index j = i; j < n; ++j) {
      const double rest = pd(before, j) - pd(i, j) - g(i).dot(z(j));
      const double value = -(area_ * g(i).dot(g(j)) + lambda_ * rest);
      L[i * n + j] = value;
      L[j * n + i] = value;
    }
  }
}

void PolygonKernel::mass1(double* M1) {
  const Index n = corners();
  columns_.resize(edges_.size());
  products_.resize(edges_.size());
  for (Index j = 0; j < n; ++j) columns_[static_cast<std::size_t>(j)] = sharp(j);
  const auto s = [&](Index j) -> const Vec3& { return columns_[static_cast<std::size_t>(j)]; };
  const auto p = [&](Index k, Index j) { return (k == j ? 1. : 0.) - edge(k).dot(s(j)); };
  // PᵀP = P − Uᵀ (Vᵀ P).
  for (Index j = 0; j < n; ++j) {
    Vec3 sum = Vec3::Zero();
    for (Index k = 0; k < n; ++k) sum += p(k, j) * edge(k);
    products_[static_cast<std::size_t>(j)] = sum;
  }
  for (Index i = 0; i < n; ++i) {
    for (Index j = i; j < n; ++j) {
      const double rest = p(i, j) - s(i).dot(products_[static_cast<std::size_t>(j)]);
      const double value = area_ * s(i).dot(s(j)) + lambda_ * rest;
      M1[i * n + j] = value;
      M1[j * n + i] = value;
    }
  }
}

}  // namespace dsc
