// Figure 10: gradient, mean curvature and distances on voxel objects of any shape, those of the
// files given.
#include "libdsc/algorithms/geodesic.h"
#include "libdsc/algorithms/mean_curvature.h"
#include "libdsc/algorithms/regularise.h"
#include "libdsc/calculus/field_operators.h"
#include "libdsc/calculus/vertex_average.h"
#include "libdsc/io/read_binary.h"
#include "libdsc/normals/curvature.h"
#include "study.h"

#include <chrono>

namespace {

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Least, 5 %, mean, 95 %, largest.
std::string spread(const Eigen::VectorXd& values) {
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  const auto at = [&](double share) {
    return study::text(
        sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))]);
  };
  return at(0) + ", " + at(0.05) + ", " + study::text(values.mean()) + ", " + at(0.95) + ", " +
         at(1);
}

void study_object(const study::Arguments& arguments, const std::string& path) {
  const std::string name = std::filesystem::path(path).stem().string();
  std::printf("\n### %s\n\n", std::filesystem::path(path).filename().string().c_str());
  study::Table table(arguments, "figure_10_" + name,
                     {"field", "least, 5 %, mean, 95 %, largest", "seconds"});
  double start = seconds();
  const auto row = [&](const char* field, const Eigen::VectorXd& values) {
    table.row({field, spread(values), study::text(seconds() - start, "%.2f")});
    start = seconds();
  };
  const dsc::BinaryVolume volume = dsc::read_binary(path);
  const dsc::Vec3 spacing = volume.grid().spacing;
  dsc::DigitalSurface surface = dsc::extract_surface(volume);
  dsc::integral_invariant_normals(surface, volume, {.radius = dsc::data_radius(spacing)});
  const dsc::FlatMesh mesh = surface.flat();

  const Eigen::VectorXd height = mesh.positions.matrix().row(2).transpose();
  const Eigen::Matrix3Xd gradients = dsc::face_gradients(mesh, height);
  row("size of the gradient of z (surface and normals included)",
      gradients.colwise().norm().transpose());

  const dsc::CurvatureField balls = dsc::integral_invariant_curvatures(
      volume, surface.surfels(),
      {.radius = dsc::data_radius(spacing, dsc::kCurvatureRadiusVoxels)});
  row("mean curvature, integral invariants", balls.mean);

  const dsc::RegularisedPositions smooth = dsc::regularise_positions(mesh);
  dsc::FlatMesh regular;  // a smooth mesh needs no projection
  regular.positions = {smooth.positions.data(), smooth.positions.cols()};
  regular.corners = mesh.corners;
  dsc::LaplaceBeltramiOptions options;
  options.time = 4 * spacing.maxCoeff() * spacing.maxCoeff();
  options.calculus.stabilization = dsc::Stabilization::mercat;
  const Eigen::VectorXd curvature = dsc::mean_curvature(regular, regular.positions, options).mean;
  row("mean curvature, Laplacian of regularised positions, diffused", curvature);

  const dsc::VertexId source = 0;
  const Eigen::VectorXd distance = dsc::geodesic_distance(mesh, {&source, 1}).distance;
  const Eigen::VectorXd reached = distance.array().isFinite().select(distance.array(), 0.).matrix();
  row("distance (0 where the source does not reach)", reached);

  study::write(arguments, "figure_10_" + name,
               {mesh,
                {dsc::scalar_field("distance", dsc::FieldOn::vertex, distance),
                 dsc::scalar_field("mean_curvature", dsc::FieldOn::vertex, curvature),
                 dsc::scalar_field("mean_curvature_ii", dsc::FieldOn::face, balls.mean),
                 dsc::vector_field("gradient", {"gx", "gy", "gz"}, dsc::FieldOn::face,
                                   {gradients.data(), gradients.cols()})}},
               study::seen(30, 20));
}

}  // namespace

int main(int argc, char** argv) {
  const study::Arguments arguments(argc, argv);
  std::puts("## Figure 10: complex objects\n\nLengths are voxels, or the image's own unit.");
  for (const std::string& path : arguments.data) study_object(arguments, path);
  if (arguments.data.empty()) std::puts("\nNo volume was given.");
  std::puts("\nPaper: shows fields on three objects, without numbers.");
}
