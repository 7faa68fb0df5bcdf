// Figure 3: the gradient on a digital plane of normal (1, 1, 1) / sqrt 3, of the function "distance
// to the centre". Its direction is wrong at every gridstep where the surfels are taken as they are,
// and converges where they are projected along estimated normals.
#include "libdsc/calculus/field_operators.h"
#include "libdsc/voxels/shapes.h"
#include "study.h"

namespace {

constexpr double kHalf = 10;  // of the box, which the domain exceeds by five voxels

/// The part of the plane in the box; the volume goes on for `margin` beyond.
study::Digitized digital_plane(double h, double margin) {
  const double size = kHalf + 5 * h;
  const dsc::Plane plane(dsc::Vec3::Ones(), 0., 2 * (size + margin));
  dsc::BinaryVolume volume = dsc::digitize(plane, dsc::Vec3(h, h, h));
  dsc::ExtractOptions options;
  options.border = dsc::Border::open;
  const dsc::Grid grid = volume.grid();
  options.part = [grid, size, h](const dsc::Surfel& s) {  // both voxels in the box
    const dsc::Vec3 outer = s.centre(grid) + 0.5 * h * s.normal();
    const dsc::Vec3 inner = outer - h * s.normal();
    return std::max(outer.cwiseAbs().maxCoeff(), inner.cwiseAbs().maxCoeff()) <= size + 1e-9;
  };
  dsc::DigitalSurface surface = dsc::extract_surface(volume, options);
  return {std::move(volume), std::move(surface)};
}

/// |G phi / |G phi| - truth| per face, the truth at the face's centre on the plane; 0 where the
/// gradient or the truth vanishes, as it may on the faces around the centre.
Eigen::ArrayXd direction_errors(const dsc::FlatMesh& mesh) {
  const Eigen::VectorXd phi = mesh.positions.matrix().colwise().norm().transpose();
  const Eigen::Matrix3Xd gradients = dsc::face_gradients(mesh, phi);
  const dsc::Vec3 n = dsc::Vec3::Ones().normalized();
  Eigen::ArrayXd errors(mesh.faces());
  for (dsc::Index f = 0; f < mesh.faces(); ++f) {
    dsc::Vec3 centre = dsc::Vec3::Zero();
    for (const dsc::VertexId v : mesh.face(f)) centre += 0.25 * mesh.positions[v];
    const dsc::Vec3 truth = (centre - centre.dot(n) * n).stableNormalized();
    const dsc::Vec3 estimate = gradients.col(f).stableNormalized();
    errors[f] = truth.norm() * estimate.norm() < 0.5 ? 0. : (estimate - truth).norm();
  }
  return errors;
}

}  // namespace

int main(int argc, char** argv) {
  const study::Arguments arguments(argc, argv);
  std::puts(
      "## Figure 3: gradient on a tilted plane\n\n"
      "Error of the direction of the gradient of the distance to the centre: root of the mean "
      "square"
      " over faces, and maximum.\n");
  study::Table table(arguments, "figure_3",
                     {"h", "faces", "naive", "max", "projected, exact normals", "max", "rate",
                      "projected, integral invariant", "max"});
  double last = 0;
  for (int level = 0; level <= (arguments.full ? 6 : 4); ++level) {
    const double h = std::pow(0.5, level);
    const double radius = dsc::shape_radius(h);
    auto [volume, surface] = digital_plane(h, radius + h);
    const study::Norms naive = study::norms(direction_errors(surface.flat(false)));
    dsc::integral_invariant_normals(surface, volume, {.radius = radius});
    const study::Norms estimated = study::norms(direction_errors(surface.flat()));
    dsc::analytic_normals(surface, dsc::Plane(dsc::Vec3::Ones(), 0., 100.));
    const Eigen::ArrayXd errors = direction_errors(surface.flat());
    const study::Norms exact = study::norms(errors);
    table.row({study::text(h, "%.6g"), std::to_string(surface.face_count()), study::text(naive.rms),
               study::text(naive.max), study::text(exact.rms), study::text(exact.max),
               level == 0 ? "" : study::text(std::log2(last / exact.rms)),
               study::text(estimated.rms), study::text(estimated.max)});
    last = exact.rms;
    if (level == 2) {
      dsc::write_result(
          (arguments.out / "figure_3.vtp").string(),
          {surface.flat(),
           {dsc::scalar_field("error", dsc::FieldOn::face, Eigen::VectorXd(errors))}});
    }
  }
  std::puts(
      "\nPaper: errors of the projected calculus in [0, 0.28], of the naive one in [0, 0.62]; 3 748"
      " 021 faces at h = 0.015; the projected error falls with h. The maximum is that of the faces"
      " next to the centre, where the direction turns within a face at every h.");
}
