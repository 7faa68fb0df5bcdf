// Figure 9: distances across the triple junction of three half planes at 120°, the interfaces of
// three labels. Two sheets unfold into one plane, so the true distance is known; the surface is
// clipped by a ball centred on the junction line, which makes each unfolded pair convex. Then the
// same on the label images given.
#include "libdsc/algorithms/geodesic.h"
#include "libdsc/io/read_labels.h"
#include "study.h"

#include <array>

namespace {

constexpr double kRadius = 10;  // of the clipping ball

/// The sheet at angle 120° k, from the z axis outwards.
dsc::Vec3 sheet(int k) {
  const double angle = 2 * M_PI * k / 3 + 0.3;  // along no axis of the grid
  return {std::cos(angle), std::sin(angle), 0};
}

/// Labels 1, 2, 3 between the sheets, in a box with room for a ball of normals.
dsc::LabelVolume sectors(double h, double margin) {
  const auto half = static_cast<dsc::Index>(std::ceil((kRadius + margin) / h)) + 1;
  dsc::Grid grid;
  grid.size = {2 * half, 2 * half, 2 * half};
  grid.spacing = dsc::Vec3::Constant(h);
  grid.origin = dsc::Vec3::Constant(-(static_cast<double>(half) - 0.5) * h);
  dsc::LabelVolume labels(grid, 1);
  for (dsc::Index z = 0; z < grid.size[2]; ++z) {
    for (dsc::Index y = 0; y < grid.size[1]; ++y) {
      for (dsc::Index x = 0; x < grid.size[0]; ++x) {
        const dsc::Vec3 p =
            grid.position(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z));
        const double turn = (std::atan2(p.y(), p.x()) - 0.3) / (2 * M_PI / 3);
        labels.set(x, y, z, 1 + static_cast<dsc::Label>(std::floor(turn + 6)) % 3);
      }
    }
  }
  return labels;
}

/// Which sheet a point is nearest to, how far along it, and its z.
struct Unfolded {
  int sheet = 0;
  double along = 0;
  double z = 0;

  explicit Unfolded(const dsc::Vec3& p) : z(p.z()) {
    for (int k = 0; k < 3; ++k) {
      if (p.dot(::sheet(k)) > along) {
        sheet = k;
        along = p.dot(::sheet(k));
      }
    }
  }
  double distance(const Unfolded& other) const {
    const double across = sheet == other.sheet ? along - other.along : along + other.along;
    return std::hypot(across, z - other.z);
  }
};

void atlas(const std::string& path) {
  const dsc::LabelVolume labels = dsc::read_labels(path);
  dsc::DigitalSurface surface = dsc::extract_surface(labels);
  dsc::integral_invariant_normals(surface, labels,
                                  {.radius = dsc::data_radius(labels.grid().spacing)});
  const dsc::VertexId source = 0;
  const dsc::GeodesicResult result = dsc::geodesic_distance(surface.flat(), {&source, 1});
  const auto finite = result.distance.array().isFinite().count();
  std::printf(
      "\nThe same on the interfaces of %zu regions of the label image given: %lld faces, %lld "
      "linels where "
      "three regions meet, %lld components; distances from one vertex are finite at %lld of %lld "
      "vertices, which are those connected with it, up to %.1f.\n",
      labels.labels().size(), static_cast<long long>(surface.face_count()),
      static_cast<long long>(surface.counts().junction_edges),
      static_cast<long long>(surface.counts().components), static_cast<long long>(finite),
      static_cast<long long>(surface.vertex_count()),
      (result.distance.array().isFinite()).select(result.distance.array(), 0.).maxCoeff());
}

}  // namespace

int main(int argc, char** argv) {
  const study::Arguments arguments(argc, argv);
  std::puts(
      "## Figure 9: distances across a triple junction\n\n"
      "Three half planes at 120° in a ball of radius 10; mean (largest) error by sheet, the sheet "
      "with the source first. The true distance unfolds two sheets.\n");
  study::Table table(
      arguments, "figure_9",
      {"h", "vertices", "junction linels", "source", "its sheet", "second", "third"});
  std::vector<double> steps{1, 0.5, 0.25};
  if (arguments.full) steps.push_back(0.125);
  for (const double h : steps) {
    const double radius = dsc::shape_radius(h);
    const dsc::LabelVolume labels = sectors(h, radius);
    dsc::ExtractOptions options;
    const dsc::Grid grid = labels.grid();
    options.part = [grid](const dsc::Surfel& s) { return s.centre(grid).norm() < kRadius; };
    dsc::DigitalSurface surface = dsc::extract_surface(labels, options);
    dsc::integral_invariant_normals(surface, labels, {.radius = radius});
    const dsc::FlatMesh mesh = surface.flat();
    for (const auto& [name, point] : {std::pair{"on a sheet", dsc::Vec3(4 * sheet(0))},
                                      {"on the junction", dsc::Vec3(0, 0, 0)}}) {
      dsc::Index nearest = 0;
      (mesh.positions.matrix().colwise() - point).colwise().squaredNorm().minCoeff(&nearest);
      const auto source = static_cast<dsc::VertexId>(nearest);
      dsc::GeodesicOptions geodesic;
      geodesic.boundary = dsc::HeatBoundary::mixed;
      const dsc::GeodesicResult result = dsc::geodesic_distance(mesh, {&source, 1}, geodesic);
      const Unfolded from(mesh.positions[nearest]);
      std::array<double, 3> sum{}, largest{}, count{};
      for (dsc::Index v = 0; v < mesh.vertices(); ++v) {
        const Unfolded to(mesh.positions[v]);
        const double error = std::abs(result.distance[v] - from.distance(to));
        const auto k = static_cast<std::size_t>((to.sheet - from.sheet + 3) % 3);
        sum[k] += error;
        largest[k] = std::max(largest[k], error);
        count[k] += 1;
      }
      const auto pair = [&](std::size_t k) {
        return study::text(sum[k] / count[k]) + " (" + study::text(largest[k]) + ")";
      };
      table.row({study::text(h), std::to_string(mesh.vertices()),
                 std::to_string(surface.counts().junction_edges), name, pair(0), pair(1), pair(2)});
      if (h == 0.25 && from.along > 1) {
        dsc::write_result(
            (arguments.out / "figure_9.vtp").string(),
            {mesh, {dsc::scalar_field("distance", dsc::FieldOn::vertex, result.distance)}});
      }
    }
  }
  std::puts("\nPaper: shows isolines at two gridsteps, without numbers.");
  for (const std::string& path : arguments.data) atlas(path);
}
