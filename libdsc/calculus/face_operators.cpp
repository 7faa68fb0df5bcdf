#include "libdsc/calculus/face_operators.h"

#include "libdsc/base/error.h"
#include "libdsc/calculus/embedding.h"
#include "libdsc/calculus/mesh_checks.h"
#include "libdsc/calculus/surfel_operators.h"

#include <Eigen/Geometry>

#include <string>

namespace dsc {

FaceOperators::FaceOperators(const Corners& X, double lambda) : X_(X), lambda_(lambda) {
  measure();
}

FaceOperators::FaceOperators(const Corners& X, const Vec3& u, double lambda, double min_cosine)
    : X_(X), lambda_(lambda) {
  if (!is_unit(u)) throw InputError("the estimated normal of a face is not a unit vector");
  measure();
  const Embedding embedding = embed(u, normal(), min_cosine);
  clamped_ = embedding.clamped;
  X_ = X_ * (Mat3::Identity() - embedding.u * embedding.u.transpose());
  measure();
}

void FaceOperators::measure() {
  const Index n = corners();
  if (n < 3) throw InputError("a face has " + std::to_string(n) + " corners; it needs at least 3");
  // Relative to the first corner, lest a far origin cost the digits of a small face.
  vector_area_.setZero();
  double scale = 0.;
  for (Index i = 0; i < n; ++i) {
    const Vec3 x = (X_.row(i) - X_.row(0)).transpose();
    const Vec3 y = (X_.row((i + 1) % n) - X_.row(0)).transpose();
    vector_area_ += 0.5 * x.cross(y);
    scale += (y - x).squaredNorm();
  }
  if (!is_area(area(), scale)) {
    throw InputError("a face has no area: its corners coincide, lie on a line or are not finite");
  }
}

Eigen::MatrixXd FaceOperators::D() const {
  const Index n = corners();
  Eigen::MatrixXd d = -Eigen::MatrixXd::Identity(n, n);
  for (Index i = 0; i < n; ++i) d(i, (i + 1) % n) = 1.;
  return d;
}

Eigen::MatrixXd FaceOperators::A() const {
  const Index n = corners();
  Eigen::MatrixXd a = 0.5 * Eigen::MatrixXd::Identity(n, n);
  for (Index i = 0; i < n; ++i) a(i, (i + 1) % n) = 0.5;
  return a;
}

Mat3 FaceOperators::bracket() const {
  const Vec3 n = normal();
  Mat3 b;
  b << 0., -n.z(), n.y(),  //
      n.z(), 0., -n.x(),   //
      -n.y(), n.x(), 0.;
  return b;
}

Eigen::Matrix3Xd FaceOperators::gradient() const { return -bracket() * co_gradient() / area(); }

FaceOperators::Corners FaceOperators::flat() const {
  const Vec3 n = normal();
  return E() * (Mat3::Identity() - n * n.transpose());
}

Eigen::Matrix3Xd FaceOperators::sharp() const {
  const Eigen::Matrix3Xd arms = (B().rowwise() - centroid().transpose()).transpose();
  return bracket() * arms / area();
}

Eigen::MatrixXd FaceOperators::projection() const {
  return Eigen::MatrixXd::Identity(corners(), corners()) - flat() * sharp();
}

Eigen::MatrixXd FaceOperators::mass0() const {
  return area() / static_cast<double>(corners()) * Eigen::MatrixXd::Identity(corners(), corners());
}

Eigen::MatrixXd FaceOperators::mass1() const {
  const Eigen::Matrix3Xd U = sharp();
  const Eigen::MatrixXd P = projection();
  return area() * U.transpose() * U + lambda_ * P.transpose() * P;
}

Eigen::MatrixXd FaceOperators::divergence() const { return -D().transpose() * mass1(); }

Eigen::MatrixXd FaceOperators::laplacian() const { return divergence() * D(); }

FaceOperators face_operators(const FlatMesh& mesh, Index f, const CalculusOptions& options) {
  options.check();
  check_mesh(mesh, options);
  if (f < 0 || f >= mesh.faces()) {
    throw UsageError("there is no face " + std::to_string(f) + " in a mesh of " +
                     std::to_string(mesh.faces()));
  }
  const auto ids = mesh.face(f);
  FaceOperators::Corners X(static_cast<Index>(ids.size()), 3);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    check_vertex(mesh, f, ids[i]);
    X.row(static_cast<Index>(i)) = mesh.positions[ids[i]].transpose();
  }
  double lambda = options.stabilization == Stabilization::mercat ? 0. : options.lambda;
  if (mesh.is_digital()) {
    const auto shapes = surfel_shapes(mesh.spacing);
    const SurfelShape& shape =
        shapes[static_cast<std::size_t>(mesh.surfels[static_cast<std::size_t>(f)].direction)];
    const SurfelOperators surfel = mesh.has_normals()
                                       ? SurfelOperators(shape, mesh.normals[f], options.min_cosine)
                                       : SurfelOperators(shape);
    lambda = SurfelLambda(options)(surfel.laplacian().s);
  }
  try {
    return mesh.has_normals() ? FaceOperators(X, mesh.normals[f], lambda, options.min_cosine)
                              : FaceOperators(X, lambda);
  } catch (const InputError& e) {
    throw InputError(face_name(mesh, f) + ": " + e.what());
  }
}

}  // namespace dsc
