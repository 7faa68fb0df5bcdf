// Curvatures, Laplacians, Poisson's equation and regularised surfaces, as a shell sees them.
#include "libdsc/io/volume_writer.h"
#include "tests/cli/program.h"
#include "tests/io/result_parsers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace dsc::test {
namespace {

double further(const nlohmann::json& report, const std::string& quantity, const char* norm) {
  for (const auto& error : report["further_errors"]) {
    if (error["quantity"] == quantity) return error[norm];
  }
  ADD_FAILURE() << "no error of " << quantity;
  return 0;
}

const Words kFineSphere = {"shape:sphere", "--gridstep", "0.05"};

/// A ball of radius 12 voxels as a file.
std::string ball_file(const Folder& folder, std::uint8_t label_below = 1) {
  const Grid grid{{31, 31, 31}, {1, 1, 1}, Vec3::Zero()};
  std::vector<std::uint8_t> values;
  for (int z = 0; z < 31; ++z) {
    for (int y = 0; y < 31; ++y) {
      for (int x = 0; x < 31; ++x) {
        const bool inside = (Vec3(x, y, z) - Vec3(15.2, 14.9, 15.1)).norm() < 12;
        values.push_back(inside ? (z < 15 ? label_below : 1) : 0);
      }
    }
  }
  const std::string path = folder / "ball.npy";
  write_volume(path, grid, std::span<const std::uint8_t>(values));
  return path;
}

TEST(Curvature, OfTheSphereIsOneWithTheErrorOfTheFormula) {
  const auto report = report_of(Words{"curvature"} + kFineSphere);
  const double r = 3 * std::sqrt(0.05);
  EXPECT_NEAR(report["error"]["mean"], r * r / 4, 0.12 * r * r / 4);
  for (const char* name : {"kappa_1", "kappa_2"}) EXPECT_LT(further(report, name, "mean"), 0.15);
  EXPECT_LT(further(report, "gaussian_curvature", "mean"), 0.3);
  EXPECT_EQ(report["further_errors"].size(), 3U) << "a sphere has no principal directions";
  const auto plain = report_of(Words{"curvature", "--form", "plain"} + kFineSphere);
  EXPECT_NEAR(plain["result"]["mean"], 1, 0.02);
}

TEST(Curvature, OfTheTorusHasItsDirections) {
  const Folder folder;
  const auto report = report_of({"curvature", "shape:torus,R=1,r=0.5", "--gridstep", "0.025",
                                 "--radius", "0.3", "-o", folder / "c.ply"});
  EXPECT_LT(report["error"]["l2"], 0.12);
  EXPECT_LT(further(report, "kappa_2", "l2"), 0.2);
  EXPECT_LT(further(report, "direction_1, radians", "mean"), 0.03);
  const PlyFile ply = read_ply(folder / "c.ply");
  const auto mean = ply.face_columns({"mean_curvature"});
  const auto gaussian = ply.face_columns({"gaussian_curvature"});
  const auto kappa = ply.face_columns({"kappa_1", "kappa_2"});
  const auto one = ply.face_columns({"k1x", "k1y", "k1z"});
  const auto two = ply.face_columns({"k2x", "k2y", "k2z"});
  ASSERT_EQ(mean.size(), ply.faces.size());
  for (std::size_t f = 0; f < mean.size(); ++f) {
    EXPECT_NEAR(mean[f], (kappa[2 * f] + kappa[2 * f + 1]) / 2, 1e-9);
    EXPECT_NEAR(gaussian[f], kappa[2 * f] * kappa[2 * f + 1], 1e-9);
    double dot = 0, length = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      dot += one[3 * f + i] * two[3 * f + i];
      length += one[3 * f + i] * one[3 * f + i];
    }
    EXPECT_NEAR(dot, 0, 1e-9);
    EXPECT_NEAR(length, 1, 1e-9);
  }
}

TEST(Curvature, AveragesToVertices) {
  const Folder folder;
  const auto report =
      report_of(Words{"curvature", "--on", "vertex", "-o", folder / "c.ply"} + kFineSphere);
  EXPECT_LT(report["error"]["mean"], 0.15);
  const PlyFile ply = read_ply(folder / "c.ply");
  EXPECT_EQ(ply.vertex_columns({"kappa_1"}).size(), ply.vertices.size());
}

TEST(Curvature, FromTheLaplacianConvergesWithoutStabilisation) {
  double last = 1;
  for (const char* h : {"0.1", "0.05", "0.025"}) {
    const auto report =
        report_of({"curvature", "shape:sphere", "--gridstep", h, "--estimator", "laplacian"});
    EXPECT_EQ(report["positions"]["kind"], "projected");
    EXPECT_EQ(report["calculus"]["lambda"], 0);
    EXPECT_LT(report["error"]["l2"], 0.75 * last);
    last = report["error"]["l2"];
  }
  EXPECT_LT(last, 0.015);
  const auto biased =
      report_of(Words{"curvature", "--estimator", "laplacian", "--lambda", "0.25"} + kFineSphere);
  EXPECT_NEAR(biased["result"]["mean"], 1.035, 0.015);
}

/// The data default: 8 voxels. The ball has radius 12.
TEST(Curvature, OfVoxelsComesFromBallsOrRegularisedPositions) {
  const Folder folder;
  const std::string ball = ball_file(folder);
  const auto ii = report_of({"curvature", ball});
  EXPECT_EQ(ii["normals"]["radius"], 8);
  EXPECT_NEAR(ii["result"]["mean"], 1 / 12., 0.2 / 12.);
  EXPECT_FALSE(ii.contains("error"));
  const auto laplacian =
      report_of({"curvature", ball, "--estimator", "laplacian", "--diffuse", "4"});
  EXPECT_EQ(laplacian["positions"]["kind"], "regularised");
  EXPECT_GT(laplacian["positions"]["mean_displacement"], 0.2);
  EXPECT_NEAR(laplacian["result"]["mean"], 1 / 12., 0.1 / 12.);
  EXPECT_GT(laplacian["result"]["min"], 0.7 / 12.);
  EXPECT_LT(laplacian["result"]["max"], 1.3 / 12.);
}

TEST(Curvature, OfLabelsComesFromTheLaplacian) {
  const Folder folder;
  const std::string ball = ball_file(folder, 2);
  const auto report = report_of({"curvature", ball, "--labels", "all", "--diffuse", "4"});
  EXPECT_EQ(report["positions"]["kind"], "regularised");
  const Outcome refused = run_dsc({"curvature", ball, "--labels", "all", "--estimator", "ii"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("laplacian"), std::string::npos);
  EXPECT_EQ(run_dsc({"curvature", ball, "--diffuse", "4"}).exit_code, 2);
  EXPECT_EQ(run_dsc({"curvature", ball, "--estimator", "laplacian", "--on", "vertex"}).exit_code,
            2);
}

/// Against the exact 2 − 6 x² on the sphere; on the torus the errors fall too.
TEST(Laplacian, ConvergesWhereItIsDiffused) {
  double last = 1;
  for (const auto& [h, t] : {std::pair{"0.1", "0.0035"}, {"0.05", "0.00175"}}) {
    const auto report = report_of(
        {"laplacian", "shape:sphere", "--gridstep", h, "--function", "x^2", "--diffuse", t});
    EXPECT_LT(report["error"]["mean"], 0.8 * last);
    last = report["error"]["mean"];
  }
  EXPECT_LT(last, 0.063);
  const auto pointwise = report_of(Words{"laplacian", "--function", "x^2"} + kFineSphere);
  EXPECT_LT(pointwise["error"]["mean"], 0.29);
  const auto naive =
      report_of(Words{"laplacian", "--function", "x^2", "--calculus", "naive"} + kFineSphere);
  EXPECT_GT(naive["error"]["mean"], 3.);
  const auto torus = report_of({"laplacian", "shape:torus", "--gridstep", "0.025", "--function",
                                "x*z", "--diffuse", "0.001"});
  EXPECT_LT(torus["error"]["l2"], 0.1 * torus["result"]["max"].get<double>());
}

TEST(Laplacian, OfVoxelsIsTakenAtRegularisedPositions) {
  const Folder folder;
  // x − 15.2 is an eigenfunction of the sphere of radius 12, of eigenvalue −2/144.
  const auto report = report_of({"laplacian", ball_file(folder), "--function", "x-15.2",
                                 "--diffuse", "4", "-o", folder / "l.csv"});
  EXPECT_EQ(report["positions"]["kind"], "regularised");
  double error = 0, size = 0;
  for (const auto& row : read_csv(folder / "l.csv").rows) {
    error += std::pow(row[4] + 2. / 144 * row[3], 2);
    size += std::pow(2. / 144 * row[3], 2);
  }
  EXPECT_LT(std::sqrt(error / size), 0.15);
}

TEST(Poisson, OnTheSphereFindsTheEigenfunctionAndRemovesTheMean) {
  const Folder folder;
  const auto report =
      report_of(Words{"poisson", "--rhs", "-2*x+5", "-o", folder / "u.csv"} + kFineSphere);
  EXPECT_NEAR(report["poisson"]["removed_mean"], 5, 0.01);
  EXPECT_EQ(report["poisson"]["free_components"], 1);
  EXPECT_EQ(report["poisson"]["fixed_vertices"], 0);
  EXPECT_LT(report["poisson"]["relative_residual"], 1e-8);
  for (const auto& row : read_csv(folder / "u.csv").rows) {
    const double length = std::sqrt(row[0] * row[0] + row[1] * row[1] + row[2] * row[2]);
    EXPECT_NEAR(row[3], row[0] / length, 0.02);
  }
}

/// Δu = 0 with u = x − 2 y on the boundary of a plane: u is that everywhere. Δ (x² + y² + z²) = 4
/// on the plane through the origin.
TEST(Poisson, OnAPlaneKeepsTheBoundaryValues) {
  const Folder folder;
  const Words plane = {"shape:plane,nx=1,ny=2,nz=4,size=2", "--gridstep", "0.05", "--estimator",
                       "analytic"};
  const auto linear =
      report_of(Words{"poisson", "--rhs", "0", "--fix", "x-2*y", "-o", folder / "u.csv"} + plane);
  EXPECT_GT(linear["poisson"]["fixed_vertices"], 50);
  EXPECT_EQ(linear["poisson"]["free_components"], 0);
  const Vec3 n = Vec3(1, 2, 4).normalized();
  const auto on_plane = [&](const std::vector<double>& row) -> Vec3 {
    const Vec3 p(row[0], row[1], row[2]);
    return p - n.dot(p) * n;
  };
  for (const auto& row : read_csv(folder / "u.csv").rows) {
    const Vec3 p = on_plane(row);
    EXPECT_NEAR(row[3], p.x() - 2 * p.y(), 0.03);
  }
  report_of(Words{"poisson", "--rhs", "4", "--fix", "x^2+y^2+z^2", "-o", folder / "v.csv"} + plane);
  for (const auto& row : read_csv(folder / "v.csv").rows) {
    EXPECT_NEAR(row[3], on_plane(row).squaredNorm(), 0.03);
  }
}

/// Of two sheets only one has a boundary, where u = 3: it is 3, the sphere's mean is 0.
TEST(Poisson, FixesOneComponentAndFreesTheOther) {
  const Folder folder;
  const Words scene = {"shape:expr:min(z+1.5,x^2+y^2+(z-0.5)^2-0.25);box=-2,2;open", "--gridstep",
                       "0.1"};
  const auto report =
      report_of(Words{"poisson", "--rhs", "0", "--fix", "3", "-o", folder / "u.csv"} + scene);
  EXPECT_EQ(report["surface"]["components"], 2);
  EXPECT_EQ(report["poisson"]["free_components"], 1);
  for (const auto& row : read_csv(folder / "u.csv").rows) {
    EXPECT_NEAR(row[3], row[2] < -1 ? 3 : 0, 1e-7);
  }
}

TEST(Poisson, HasNothingToFixOnAClosedSurface) {
  const Outcome outcome = run_dsc(Words{"poisson", "--rhs", "x", "--fix", "1"} + kFineSphere);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("--fix"), std::string::npos);
  EXPECT_EQ(run_dsc(Words{"poisson", "--rhs", "x+"} + kFineSphere).exit_code, 2);
}

TEST(Surface, RegularisedKeepsItsFacesAndNearsTheSphere) {
  const Folder folder;
  report_of(Words{"surface", "-o", folder / "raw.ply"} + kFineSphere);
  const auto report =
      report_of(Words{"surface", "--regularise", "-o", folder / "smooth.ply"} + kFineSphere);
  EXPECT_EQ(report["positions"]["kind"], "regularised");
  EXPECT_GT(report["positions"]["iterations"], 0);
  const PlyFile raw = read_ply(folder / "raw.ply"), smooth = read_ply(folder / "smooth.ply");
  EXPECT_EQ(raw.faces, smooth.faces);
  const auto deviation = [](const PlyFile& ply) {
    double sum = 0;
    for (const auto& p : ply.vertices) {
      sum += std::pow(std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) - 1, 2);
    }
    return std::sqrt(sum / static_cast<double>(ply.vertices.size()));
  };
  EXPECT_LT(deviation(smooth), 0.1 * deviation(raw));
}

/// A surface with its normals in a file is regularised as the voxels are; the result, a mesh like
/// any other, has the sphere's curvature and functions.
TEST(SmoothMesh, GoesThroughFiles) {
  const Folder folder;
  report_of(Words{"normals", "-o", folder / "normals.ply"} + kFineSphere);
  report_of(Words{"surface", "--regularise", "-o", folder / "direct.ply"} + kFineSphere);
  const auto report =
      report_of({"surface", folder / "normals.ply", "--regularise", "-o", folder / "smooth.ply"});
  EXPECT_EQ(report["positions"]["kind"], "regularised");
  const PlyFile direct = read_ply(folder / "direct.ply"), smooth = read_ply(folder / "smooth.ply");
  ASSERT_EQ(direct.vertices.size(), smooth.vertices.size());
  for (std::size_t v = 0; v < direct.vertices.size(); ++v) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(direct.vertices[v][k], smooth.vertices[v][k], 1e-3 * 0.05);
    }
  }
  report_of(Words{"surface", "-o", folder / "mesh.off"} + Words{folder / "direct.ply"});
  const auto curvature = report_of({"curvature", folder / "mesh.off", "--diffuse", "0.00175"});
  EXPECT_EQ(curvature["positions"]["kind"], "as given");
  EXPECT_NEAR(curvature["result"]["mean"], 1, 0.02);
  EXPECT_GT(curvature["result"]["min"], 0.85);
  EXPECT_LT(curvature["result"]["max"], 1.15);
  report_of({"laplacian", folder / "mesh.off", "--function", "z", "--diffuse", "0.00175", "-o",
             folder / "l.csv"});
  for (const auto& row : read_csv(folder / "l.csv").rows) EXPECT_NEAR(row[4], -2 * row[2], 0.15);
  report_of({"poisson", folder / "mesh.off", "--rhs", "-2*z", "-o", folder / "u.csv"});
  for (const auto& row : read_csv(folder / "u.csv").rows) EXPECT_NEAR(row[3], row[2], 0.02);
  EXPECT_EQ(run_dsc({"curvature", folder / "mesh.off", "--estimator", "ii"}).exit_code, 2);
  EXPECT_EQ(
      run_dsc({"surface", folder / "mesh.off", "--regularise", "-o", folder / "x.ply"}).exit_code,
      3);
}

TEST(CurvatureResults, AreTheSameBytesForAnyThreadCount) {
  const Folder folder;
  const std::string ball = ball_file(folder);
  for (const Words& command :
       {Words{"curvature"}, Words{"curvature", "--estimator", "laplacian", "--diffuse", "2"},
        Words{"laplacian", "--function", "x*y"}, Words{"poisson", "--rhs", "x"},
        Words{"surface", "--regularise"}}) {
    std::string reference;
    for (const char* threads : {"1", "4"}) {
      const Outcome outcome =
          run_dsc(command + Words{ball, "--threads", threads, "-o", folder / "r.ply"});
      ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
      const std::string bytes = read_file(folder / "r.ply");
      if (reference.empty()) reference = bytes;
      EXPECT_TRUE(bytes == reference) << command[0] << " with " << threads << " threads";
    }
  }
}

}  // namespace
}  // namespace dsc::test
