#include "libdsc/normals/smallest_eigenvector.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>

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
// the root of a half ball. Then u is along every row of the adjugate of V - root I, which has
// rank 1. Only + - * / and square roots: many times faster than the iterative solver, the same bits
// everywhere, and, unlike the formula with arc cosines, no digits lost where the two large
// eigenvalues are close.
SmallestEigenvector smallest_eigenvector(const Mat3& v) {
  const double trace = v(0, 0) + v(1, 1) + v(2, 2);
  if (!(trace > 0)) return {};
  const double scale = 1. / trace;
  if (!(scale <= std::numeric_limits<double>::max())) return smallest_eigenvector(0x1p300 * v);
  const double xx = scale * v(0, 0), yy = scale * v(1, 1), zz = scale * v(2, 2);
  const double xy = scale * v(0, 1), xz = scale * v(0, 2), yz = scale * v(1, 2);
  const double minor_x = yy * zz - yz * yz;
  const double minors = minor_x + (xx * zz - xz * xz) + (xx * yy - xy * xy);
  // The slope at 0 bounds that at the root.
  if (!(minors > kClosedFormGap)) return by_iteration(v / trace);
  const double det = xx * minor_x + xy * (yz * xz - xy * zz) + xz * (xy * yz - yy * xz);
  double root = std::max(0., (1. - 2. * std::sqrt(std::max(0., 1. - 3. * minors))) / 3.);
  double slope = minors - root * (2. - 3. * root);
  for (int i = 0; i < 50 && slope > kClosedFormGap; ++i) {
    const double step = (det - root * (minors - root * (1. - root))) / slope;
    root += step;
    slope = minors - root * (2. - 3. * root);
    if (!(step > kLastStep)) break;
  }
  // slope is now the product of the distances to the two other eigenvalues, which sum to at most 1.
  if (!(slope > kClosedFormGap)) return by_iteration(v / trace);

  // The adjugate, a multiple of u u^T; its largest diagonal entry is in its longest row.
  const double a = xx - root, b = yy - root, c = zz - root;
  const double ax = b * c - yz * yz, ay = xz * yz - xy * c, az = xy * yz - b * xz;
  const double by = a * c - xz * xz, bz = xy * xz - a * yz;
  const double cz = a * b - xy * xy;
  Vec3 u(ax, ay, az);
  if (by > ax && by >= cz)
    u = Vec3(ay, by, bz);
  else if (cz > ax)
    u = Vec3(az, bz, cz);
  return {u / std::sqrt(u.squaredNorm()), true};
}

}  // namespace dsc
