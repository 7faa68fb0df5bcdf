#include "libdsc/normals/smallest_eigenvector.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace dsc {
namespace {

constexpr double kUniqueGap = 1e-10;     // of the trace
constexpr double kClosedFormGap = 1e-3;  // below: the iterative solver decides
constexpr double kLastStep = 1e-9;       // what is left is below step^2 / gap

SmallestEigenvector by_iteration(const Mat3& a) {
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(a);
  const Vec3& values = solver.eigenvalues();
  if (solver.info() != Eigen::Success || !(values[1] - values[0] > kUniqueGap)) return {};
  return {solver.eigenvectors().col(0), true};
}

}  // namespace

// The root of the characteristic polynomial by Newton: below the smallest root the polynomial is
// concave and rising, so the iteration climbs to that root and cannot pass it. It starts where that
// root would be if the other two were equal, the least that trace and minors allow, which is nearly
// the root of a half ball. Then u is orthogonal to every row of V - root I. Only + - * / and square
// roots: many times faster than the iterative solver, the same bits everywhere, and, unlike the
// formula with arc cosines, no digits lost where the two large eigenvalues are close.
SmallestEigenvector smallest_eigenvector(const Mat3& v) {
  const double trace = v.trace();
  if (!(trace > 0)) return {};
  const Mat3 a = v / trace;
  const double minors = a(0, 0) * a(1, 1) - a(0, 1) * a(0, 1) +  //
                        a(0, 0) * a(2, 2) - a(0, 2) * a(0, 2) +  //
                        a(1, 1) * a(2, 2) - a(1, 2) * a(1, 2);
  if (!(minors > kClosedFormGap)) return by_iteration(a);  // the slope at 0 bounds that at the root
  const double det = a.determinant();
  double root = std::max(0., (1. - 2. * std::sqrt(std::max(0., 1. - 3. * minors))) / 3.);
  double slope = minors - root * (2. - 3. * root);
  for (int i = 0; i < 50 && slope > kClosedFormGap; ++i) {
    const double step = (det - root * (minors - root * (1. - root))) / slope;
    root += step;
    slope = minors - root * (2. - 3. * root);
    if (!(step > kLastStep)) break;
  }
  // slope is now the product of the distances to the two other eigenvalues, which sum to at most 1.
  if (!(slope > kClosedFormGap)) return by_iteration(a);

  const Mat3 b = a - root * Mat3::Identity();
  const Vec3 candidates[3] = {b.col(0).cross(b.col(1)), b.col(1).cross(b.col(2)),
                              b.col(2).cross(b.col(0))};
  Vec3 best = candidates[0];
  for (const Vec3& c : candidates) {
    if (c.squaredNorm() > best.squaredNorm()) best = c;
  }
  return {best.normalized(), true};
}

}  // namespace dsc
