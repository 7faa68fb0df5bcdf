/// \file
/// Every operator of the polygonal calculus on one face, as small dense matrices.
///
/// This is the readable reference: it follows Table 1 of Coeurjolly and Lachaud, 'A Simple Discrete
/// Calculus for Digital Surfaces' (after de Goes et al. 2020), word by word, with the sign of the
/// gradient corrected. The assemblers compute the same numbers faster.
///
/// The face has n >= 3 corners, the rows of X, counter-clockwise seen from outside; it may be
/// non-planar or non-convex. A 0-form is a value a corner; a 1-form a value an edge, edge i running
/// from corner i to corner i + 1. For every face, with n its normal:
///     G 1 = 0,  G X = I − n nᵀ,  U V = I − n nᵀ,  G = U D,  P V = 0,  L 1 = 0,  L = Lᵀ <= 0.
/// With an estimated normal u, X is replaced by X (I − u uᵀ) first (embedding.h): n is then u.
#pragma once

#include "libdsc/calculus/options.h"
#include "libdsc/surface/flat_mesh.h"

#include <Eigen/Core>

namespace dsc {

/// Dense matrices of one face, each computed when it is asked for.
class FaceOperators {
 public:
  /// n × 3: a corner, or an edge, a row.
  using Corners = Eigen::Matrix<double, Eigen::Dynamic, 3>;

  /// The operators on the corners X (n × 3) as they are; `lambda` >= 0 weighs M1's second part.
  /// \throws InputError where n < 3, a coordinate is not finite or the vector area vanishes.
  explicit FaceOperators(const Corners& X, double lambda = 0.25);
  /// The operators on the corners projected along the unit normal `u`.
  /// \throws InputError as above, or where u is not a unit vector.
  FaceOperators(const Corners& X, const Vec3& u, double lambda = 0.25,
                double min_cosine = CalculusOptions().min_cosine);

  Index corners() const { return X_.rows(); }  ///< n
  bool clamped() const { return clamped_; }    ///< u was tilted back, see embedding.h

  const Corners& X() const { return X_; }  ///< n × 3, after projection
  Eigen::MatrixXd D() const;               ///< n × n, 0-form to 1-form: φ(i+1) − φ(i)
  Eigen::MatrixXd A() const;               ///< n × n, average of an edge's two ends
  Corners E() const { return D() * X_; }   ///< n × 3, edge vectors
  Corners B() const { return A() * X_; }   ///< n × 3, edge midpoints
  Vec3 centroid() const { return X_.colwise().mean(); }      ///< c, mean of the corners
  const Vec3& vector_area() const { return vector_area_; }   ///< ½ Σ x(i) × x(i+1)
  double area() const { return vector_area_.norm(); }        ///< a
  Vec3 normal() const { return vector_area_.normalized(); }  ///< n
  Mat3 bracket() const;                                      ///< [n], so that [n] q = n × q

  Eigen::Matrix3Xd co_gradient() const { return E().transpose() * A(); }  ///< 3 × n, integrated
  Eigen::Matrix3Xd gradient() const;  ///< G = −(1/a) [n] Eᵀ A, 3 × n
  Corners flat() const;               ///< V = E (I − n nᵀ), n × 3: vector to 1-form
  Eigen::Matrix3Xd sharp() const;     ///< U = (1/a) [n] (Bᵀ − c 1ᵀ), 3 × n: 1-form to vector
  Eigen::MatrixXd projection() const;  ///< P = I − V U, n × n: what no vector explains of a 1-form
  Eigen::MatrixXd mass0() const;       ///< M0 = (a/n) I
  Eigen::MatrixXd mass1() const;       ///< M1 = a UᵀU + λ PᵀP
  Eigen::MatrixXd divergence() const;  ///< Div = −Dᵀ M1, 1-form to integrated divergence
  Eigen::MatrixXd laplacian() const;   ///< L = −Dᵀ M1 D, weak, negative semi-definite
  /// 1 × n: the integrated curl of a 1-form, its sum around the face (Stokes); curl D = 0.
  Eigen::RowVectorXd curl() const { return Eigen::RowVectorXd::Ones(corners()); }

 private:
  void measure();

  Corners X_;
  Vec3 vector_area_;
  double lambda_;
  bool clamped_ = false;
};

/// The operators on face `f` of `mesh`, projected where the mesh has normals.
/// \throws InputError naming the face; UsageError where `options` has a stabilization for
/// rectangles and the mesh is not a digital surface.
FaceOperators face_operators(const FlatMesh& mesh, Index f, const CalculusOptions& options = {});

}  // namespace dsc
