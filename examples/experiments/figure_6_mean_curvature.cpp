// Figure 6: mean curvature on Goursat's surface from the Laplacian of the positions, H = -1/2 M0^-1
// (L X).u, pointwise and after one implicit step of heat of t = 0.04. X is the vertices projected
// onto the smooth surface, u the integral invariant normals averaged to vertices.
#include "libdsc/algorithms/mean_curvature.h"
#include "libdsc/calculus/vertex_average.h"
#include "libdsc/normals/curvature.h"
#include "libdsc/voxels/implicit_curvature.h"
#include "libdsc/voxels/shapes.h"
#include "smooth_picture.h"

namespace {

constexpr double kTime = 0.04;

/// Goursat's surface, moved against the grid.
class Moved final : public dsc::ImplicitShape {
 public:
  explicit Moved(const dsc::Vec3& by) : by_(by) {}
  double value(const dsc::Vec3& p) const override { return goursat_.value(p - by_); }
  dsc::Vec3 gradient(const dsc::Vec3& p) const override { return goursat_.gradient(p - by_); }
  dsc::Mat3 hessian(const dsc::Vec3& p) const override { return goursat_.hessian(p - by_); }
  Eigen::AlignedBox3d bounds() const override { return goursat_.bounds().translated(by_); }
  std::string name() const override { return "moved goursat"; }

 private:
  dsc::Goursat goursat_;
  dsc::Vec3 by_;
};

/// A digitization with what the errors are measured against.
struct Scene {
  const dsc::ImplicitShape& shape;
  study::Digitized digital;
  Eigen::Matrix3Xd points;  ///< X
  Eigen::ArrayXd truth;     ///< H there

  Scene(const dsc::ImplicitShape& s, double h)
      : shape(s),
        digital(study::digitized(s, h)),
        points(dsc::project_points(s, digital.surface.positions()).points),
        truth(points.cols()) {
    for (dsc::Index v = 0; v < truth.size(); ++v) {
      truth[v] = dsc::implicit_curvature(shape, points.col(v)).value().mean;
    }
  }
  dsc::FlatMesh mesh(bool projected) const { return digital.surface.flat(projected); }
  Eigen::VectorXd curvature(bool projected, double time, const dsc::VertexNormals& u,
                            const dsc::CalculusOptions& calculus) const {
    dsc::LaplaceBeltramiOptions options;
    options.time = time;
    options.calculus = calculus;
    return dsc::mean_curvature(mesh(projected), {points.data(), points.cols()}, u, options).mean;
  }
  std::string error(bool projected, double time, const dsc::VertexNormals& u,
                    const dsc::CalculusOptions& calculus) const {
    return study::rms_and_max(curvature(projected, time, u, calculus).array() - truth);
  }
};

/// The plain mean of the normals around each vertex; vertex_normals() weighs them as M0 does.
dsc::VertexNormals plain_average(const dsc::FlatMesh& mesh) {
  dsc::VertexNormals result{Eigen::Matrix3Xd::Zero(3, mesh.vertices()), 0};
  for (dsc::Index f = 0; f < mesh.faces(); ++f) {
    for (const dsc::VertexId v : mesh.face(f)) result.u.col(v) += mesh.normals[f];
  }
  result.u.colwise().normalize();
  return result;
}

dsc::VertexNormals true_normals(const Scene& scene) {
  dsc::VertexNormals result{scene.points, 0};
  for (dsc::Index v = 0; v < scene.points.cols(); ++v) {
    result.u.col(v) = scene.shape.gradient(scene.points.col(v)).normalized();
  }
  return result;
}

void use_two_balls(study::Digitized& digital, double radius) {
  dsc::integral_invariant_normals(digital.surface, digital.volume,
                                  {.radius = radius, .centre = dsc::BallCentre::voxel_pair});
}

void beside_the_paper(const study::Arguments& arguments) {
  const double h = 0.25, radius = dsc::shape_radius(h);
  study::Table table(arguments, "figure_6_paper",
                     {"h = 0.25", "naive", "naive, diffused", "projected", "projected, diffused"});
  const auto row = [&](const std::string& name, const Scene& scene, const dsc::VertexNormals& u,
                       const dsc::CalculusOptions& calculus) {
    table.row({name, scene.error(false, 0, u, calculus), scene.error(false, kTime, u, calculus),
               scene.error(true, 0, u, calculus), scene.error(true, kTime, u, calculus)});
  };
  table.row({"paper", "0.059 (0.197)", "0.051 (0.146)", "0.025 (0.155)", "0.003 (0.022)"});
  table.row({"DGtal", "0.0590 (0.192)", "0.0505 (0.138)", "0.0246 (0.151)", "0.0034 (0.026)"});
  const dsc::Goursat goursat;
  Scene scene(goursat, h);
  use_two_balls(scene.digital, radius);
  const dsc::VertexNormals two = plain_average(scene.mesh(true));
  row("ours, two balls", scene, two, {});
  row("λ = 0.15", scene, two, {.lambda = 0.15});
  row("λ = 0.1", scene, two, {.lambda = 0.1});
  row("λ_f = 0", scene, two, study::mercat());
  row("u weighted as M0", scene, dsc::vertex_normals(scene.mesh(true)), {});
  row("u of the surface", scene, true_normals(scene), {});
  row("u of the surface, λ_f = 0", scene, true_normals(scene), study::mercat());
  use_two_balls(scene.digital, 3 * std::cbrt(h));
  row("r = 3 h^(1/3)", scene, plain_average(scene.mesh(true)), {});
  dsc::integral_invariant_normals(scene.digital.surface, scene.digital.volume, {.radius = radius});
  row("one ball", scene, plain_average(scene.mesh(true)), {});
  row("one ball, u weighted as M0", scene, dsc::vertex_normals(scene.mesh(true)), {});
  dsc::analytic_normals(scene.digital.surface, goursat);
  row("exact normals", scene, plain_average(scene.mesh(true)), {});
  row("exact normals, λ_f = 0", scene, plain_average(scene.mesh(true)), study::mercat());
  for (const auto& [name, by] : {std::pair{"moved by (½, 0, 0) h", dsc::Vec3(0.5, 0, 0)},
                                 {"moved by (½, ½, 0) h", dsc::Vec3(0.5, 0.5, 0)},
                                 {"moved by (½, ½, ½) h", dsc::Vec3(0.5, 0.5, 0.5)},
                                 {"moved by (0.3, 0.1, 0.2) h", dsc::Vec3(0.3, 0.1, 0.2)}}) {
    const Moved moved(by * h);
    Scene other(moved, h);
    use_two_balls(other.digital, radius);
    row(name, other, plain_average(other.mesh(true)), {});
  }
}

}  // namespace

int main(int argc, char** argv) {
  const study::Arguments arguments(argc, argv);
  const dsc::Goursat goursat;
  std::puts(
      "## Figure 6: mean curvature of Goursat's surface\n\n"
      "Root of the mean square (largest) error over vertices; exact values from the derivatives of "
      "f. The paper names neither its norms nor all of its conventions; with the normals of its "
      "library, each from a ball on the inner and one on the outer voxel of a surfel, and their "
      "plain mean at vertices, its means come out. The rows below that change one thing at a "
      "time.\n");
  beside_the_paper(arguments);
  std::puts(
      "\nSo the paper's figures are met with the normals of its library: the naive ones as they "
      "stand, the projected pointwise ones with λ = 0.15, the diffused ones with λ = 0.1 or none; "
      "and "
      "both projected pairs at once with λ_f = 0 where u is the surface's own normal. The maxima "
      "with "
      "λ = 0.25 are a little above the paper's, but they are those of single vertices: where the "
      "grid lies changes the pointwise one up to fourfold and the diffused one by a fifth.");
  std::puts("\nOver h, with normals from one ball, weighted as M0 at vertices:\n");
  study::Table table(arguments, "figure_6",
                     {"h", "naive", "naive, diffused", "projected", "projected, diffused",
                      "λ_f = 0", "λ_f = 0, diffused", "integral invariant, r = 2 h^(1/3)"});
  std::vector<double> steps{0.5, 0.25, 0.125};
  if (arguments.full) steps.push_back(0.0625);
  for (const double h : steps) {
    const Scene scene(goursat, h);
    const dsc::DigitalSurface& surface = scene.digital.surface;
    const dsc::VertexNormals u = dsc::vertex_normals(surface.flat());
    const dsc::CurvatureField balls = dsc::integral_invariant_curvatures(
        scene.digital.volume, surface.surfels(), {.radius = 2 * std::cbrt(h)});
    const Eigen::VectorXd averaged =
        dsc::average_to_vertices(surface.flat(), balls.mean.transpose()).transpose();
    table.row({study::text(h), scene.error(false, 0, u, {}), scene.error(false, kTime, u, {}),
               scene.error(true, 0, u, {}), scene.error(true, kTime, u, {}),
               scene.error(true, 0, u, study::mercat()),
               scene.error(true, kTime, u, study::mercat()),
               study::rms_and_max(averaged.array() - scene.truth)});
    if (h == 0.25) {
      study::write_picture(arguments, "figure_6", goursat, surface,
                           {{"naive", scene.curvature(false, kTime, u, {})},
                            {"projected", scene.curvature(true, kTime, u, {})},
                            {"integral_invariant", averaged},
                            {"exact", scene.truth}},
                           study::seen(30, 25, {{scene.truth.minCoeff(), scene.truth.maxCoeff()}}));
    }
  }
  std::puts(
      "\nWith raw pointels as X the same formula means nothing. Pointwise the projected error does "
      "not fall with h for any λ_f; diffused it does until the bias of t = 0.04 is left.");
}
