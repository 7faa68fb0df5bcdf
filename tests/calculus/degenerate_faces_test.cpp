// The laws of the operators where faces are hardly faces: each entry point either keeps the laws to
// the rounding of their own terms or refuses the face by its number.
#include "libdsc/base/error.h"
#include "libdsc/calculus/assembly.h"
#include "libdsc/calculus/face_operators.h"
#include "libdsc/calculus/field_operators.h"
#include "libdsc/calculus/global_operators.h"
#include "libdsc/calculus/heat_kernel_laplacian.h"
#include "libdsc/calculus/laplacian_pattern.h"
#include "libdsc/calculus/vertex_average.h"
#include "tests/calculus/meshes.h"

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include <cmath>
#include <functional>
#include <string>

namespace dsc {
namespace {

using Corners = FaceOperators::Corners;
using testing::OwnedMesh;

constexpr double kScales[] = {1e-12, 1e-6, 1., 1e6, 1e12};

struct Face {
  std::string name;
  Corners X;
};

Corners rows(std::initializer_list<Vec3> points) {
  Corners X(static_cast<Index>(points.size()), 3);
  Index i = 0;
  for (const Vec3& p : points) X.row(i++) = p.transpose();
  return X;
}

/// Polygons with an area, however little of one, in a turned plane.
std::vector<Face> thin_faces() {
  std::vector<Face> faces;
  for (const double width : {1e-1, 1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13, 1e-15, 1e-17}) {
    const std::string w = " " + std::to_string(std::log10(width));
    faces.push_back({"sliver" + w, rows({{0, 0, 0}, {1, 0, 0}, {0.4, width, 0}})});
    faces.push_back({"strip" + w, rows({{0, 0, 0}, {1, 0, 0}, {1, width, 0}, {0, width, 0}})});
    faces.push_back({"cap" + w, rows({{0, 0, 0}, {1, width, 0}, {2, 0, 0}, {1, 2 * width, 0}})});
    faces.push_back(
        {"near corner" + w, rows({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {-width, 0.5, 0}})});
    faces.push_back(
        {"near repeat" + w, rows({{0, 0, 0}, {width, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}})});
    faces.push_back({"fold" + w, rows({{0, 0, 0}, {1, 0, width}, {1, 1, 0}, {0, 1, -width}})});
    faces.push_back(
        {"saddle" + w,
         rows({{1, 1, 1 / width}, {-1, 1, -1 / width}, {-1, -1, 1 / width}, {1, -1, -1 / width}})});
    faces.push_back({"bow" + w, rows({{0, 0, 0}, {1, 1, 0}, {1 + width, 0, 0}, {0, 1, 0}})});
  }
  faces.push_back(
      {"repeated corner", rows({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}})});
  faces.push_back(
      {"spike", rows({{0, 0, 0}, {1, 0, 0}, {5, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}})});
  faces.push_back({"flat corner", rows({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}})});
  faces.push_back(
      {"twice around", rows({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}})});
  std::mt19937 random(5);
  std::normal_distribution<double> gauss;
  for (int n = 3; n <= 12; ++n) {
    for (int trial = 0; trial < 30; ++trial) {
      Corners X(n, 3);
      for (double& x : X.reshaped()) x = gauss(random);
      faces.push_back({"random of " + std::to_string(n), X});
    }
  }
  return faces;
}

/// Polygons without any.
std::vector<Face> faces_without_area() {
  const double nan = std::nan(""), inf = INFINITY;
  return {
      {"a point", rows({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}})},
      {"two points", rows({{0, 0, 0}, {1, 2, 3}, {0, 0, 0}, {1, 2, 3}})},
      {"a line", rows({{0, 0, 0}, {1, 1, 1}, {3, 3, 3}})},
      {"a line of five",
       rows({{0, 0, 0}, {0.1, 0.2, 0.3}, {0.3, 0.6, 0.9}, {0.2, 0.4, 0.6}, {0.7, 1.4, 2.1}})},
      {"there and back", rows({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 0, 0}})},
      {"a figure of eight", rows({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}})},
      {"not a number", rows({{0, 0, 0}, {1, nan, 0}, {0, 1, 0}})},
      {"infinite", rows({{0, 0, 0}, {1, 0, 0}, {0, inf, 0}})},
      {"an area beyond doubles", rows({{0, 0, 0}, {1e160, 0, 0}, {0, 1e160, 0}})},
      {"an area below doubles", rows({{0, 0, 0}, {1e-170, 0, 0}, {0, 1e-170, 0}})},
  };
}

Corners turned(const Corners& X, double scale, const Vec3& shift) {
  const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, -3).normalized()).toRotationMatrix();
  return scale * ((X * turn.transpose()).rowwise() + shift.transpose());
}

/// |difference| in roundings of the terms that were subtracted.
template <class A, class B>
double in_roundings(const A& difference, const B& size) {
  return difference.norm() / (std::numeric_limits<double>::epsilon() * size);
}

/// The identities of every face, each to 1000 roundings of its terms.
void expect_laws(const FaceOperators& f, const std::string& what) {
  constexpr double kRoundings = 1000;
  const Index n = f.corners();
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(n);
  const Eigen::MatrixXd D = f.D(), G = f.gradient(), V = f.flat(), U = f.sharp(),
                        P = f.projection(), M1 = f.mass1(), L = f.laplacian();
  const Mat3 T = Mat3::Identity() - f.normal() * f.normal().transpose();
  for (const Eigen::MatrixXd* m : {&G, &V, &U, &P, &M1, &L}) ASSERT_TRUE(m->allFinite()) << what;
  // The terms: V is E without its part along n, U and G are sums of edges over the area, and with
  // UV, P and the direction of n itself they reach |E|^2 / a, however much of that cancels. Edges
  // carry the rounding of the corners that they are differences of.
  const double edges = f.E().norm(), area = f.area();
  const double corners = 1 + f.X().norm() / edges;
  const double u = edges / area, uv = 1 + edges * u, m1 = area * u * u + uv * uv;
  EXPECT_LT(in_roundings(G * one, corners * u), kRoundings) << what << ": G 1 = 0";
  EXPECT_LT(in_roundings(G * f.X() - T, corners * uv), kRoundings) << what << ": G X = I - n nt";
  EXPECT_LT(in_roundings(U * V - T, corners * uv), kRoundings) << what << ": U V = I - n nt";
  EXPECT_LT(in_roundings(G - U * D, corners * u), kRoundings) << what << ": G = U D";
  EXPECT_LT(in_roundings(P * V, corners * uv * edges), kRoundings) << what << ": P V = 0";
  EXPECT_LT(in_roundings(L * one, m1), kRoundings) << what << ": L 1 = 0";
  EXPECT_LT(in_roundings(L - L.transpose(), m1), kRoundings) << what << ": L = Lt";
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(L);
  EXPECT_LT(eigen.eigenvalues().maxCoeff(), kRoundings * 1e-16 * m1) << what << ": L <= 0";
}

OwnedMesh single(const Corners& X) {
  OwnedMesh mesh;
  std::vector<VertexId> ids;
  for (Index i = 0; i < X.rows(); ++i) ids.push_back(mesh.add_vertex(X.row(i).transpose()));
  mesh.add_face(ids);
  return mesh;
}

/// What the assemblers make of the only face is what its own operators are.
void expect_assembled(const FaceOperators& f, const Corners& X, const std::string& what) {
  constexpr double kRoundings = 1000;
  const OwnedMesh owned = single(X);
  const FlatMesh mesh = owned.view();
  const Eigen::MatrixXd L(laplacian_matrix(mesh)), M1(mass1_matrix(mesh)), G(gradient_matrix(mesh)),
      U(sharp_matrix(mesh)), V(flat_matrix(mesh));
  const double edges = f.E().norm(), area = f.area();
  const double corners = 1 + f.X().norm() / edges;
  const double u = edges / area, uv = 1 + edges * u, m1 = area * u * u + uv * uv;
  EXPECT_LT(in_roundings(L - f.laplacian(), corners * 4 * m1), kRoundings) << what << ": L";
  EXPECT_LT(in_roundings(M1 - f.mass1(), corners * m1), kRoundings) << what << ": M1";
  EXPECT_LT(in_roundings(G - f.gradient(), corners * uv * u), kRoundings) << what << ": G";
  EXPECT_LT(in_roundings(U - f.sharp(), corners * uv * u), kRoundings) << what << ": U";
  EXPECT_LT(in_roundings(V - f.flat(), corners * uv * edges), kRoundings) << what << ": V";
}

TEST(DegenerateFaces, KeepTheLawsAtEveryScaleOrAreRefused) {
  Index kept = 0, refused = 0;
  for (const Face& face : thin_faces()) {
    for (const double scale : kScales) {
      for (const double shift : {0., 1., 1e3}) {
        const Corners X = turned(face.X, scale, Vec3(shift, -2 * shift, shift));
        const std::string what =
            face.name + " x " + std::to_string(std::log10(scale)) + " + " + std::to_string(shift);
        const OwnedMesh mesh = single(X);
        try {
          const FaceOperators f(X);
          ++kept;
          expect_laws(f, what);
          expect_assembled(f, X, what);
        } catch (const InputError& error) {
          ++refused;
          EXPECT_THROW(laplacian_matrix(mesh.view()), InputError) << what << ": " << error.what();
        }
        if (HasFailure()) return;
      }
    }
  }
  EXPECT_GT(kept, 3000);
  EXPECT_GT(refused, 100);
}

TEST(DegenerateFaces, ThinOnesKeepTheLawsUnderEstimatedNormalsToo) {
  std::mt19937 random(11);
  Index kept = 0, refused = 0;
  for (const Face& face : thin_faces()) {
    for (const double scale : kScales) {
      for (const double shift : {0., 1., 1e3}) {
        const Corners X = turned(face.X, scale, Vec3(shift, -2 * shift, shift));
        const std::string what = face.name + " x " + std::to_string(std::log10(scale)) + " + " +
                                 std::to_string(shift) + " projected";
        try {
          const FaceOperators own(X);
          for (int trial = 0; trial < 3; ++trial) {
            const Vec3 u = (own.normal() + 0.9 * testing::random_unit(random)).normalized();
            try {
              const FaceOperators f(X, u);
              ++kept;
              expect_laws(f, what);
            } catch (const InputError&) {  // the projection has no area
              ++refused;
            }
            if (HasFailure()) return;
          }
        } catch (const InputError&) {
        }
      }
    }
  }
  EXPECT_GT(kept, 10000);
  EXPECT_GT(refused, 0);
}

/// A good face, the bad one, a good face: each entry point names face 1.
struct Entry {
  const char* name;
  std::function<void(const FlatMesh&)> call;
};

/// All that makes operators of a mesh.
const std::vector<Entry>& entries() {
  static const std::vector<Entry> all = {
      {"assemble_laplacian", [](const FlatMesh& m) { (void)assemble_laplacian(m); }},
      {"laplacian_matrix", [](const FlatMesh& m) { (void)laplacian_matrix(m); }},
      {"mass0_matrix", [](const FlatMesh& m) { (void)mass0_matrix(m); }},
      {"mass1_matrix", [](const FlatMesh& m) { (void)mass1_matrix(m); }},
      {"gradient_matrix", [](const FlatMesh& m) { (void)gradient_matrix(m); }},
      {"flat_matrix", [](const FlatMesh& m) { (void)flat_matrix(m); }},
      {"sharp_matrix", [](const FlatMesh& m) { (void)sharp_matrix(m); }},
      {"divergence_matrix", [](const FlatMesh& m) { (void)divergence_matrix(m); }},
      {"face_gradients",
       [](const FlatMesh& m) { (void)face_gradients(m, Eigen::VectorXd::Zero(m.vertices())); }},
      {"integrated_divergence",
       [](const FlatMesh& m) {
         (void)integrated_divergence(m, Eigen::Matrix3Xd::Zero(3, m.faces()));
       }},
      {"face_operators", [](const FlatMesh& m) { (void)face_operators(m, 1); }},
      {"LaplacianPattern", [](const FlatMesh& m) { (void)LaplacianPattern(m).assemble(m); }},
      {"average_to_vertices",
       [](const FlatMesh& m) {
         (void)average_to_vertices(m, Eigen::MatrixXd::Zero(2, m.faces()));
       }},
      {"vertex_normals", [](const FlatMesh& m) { (void)vertex_normals(m); }},
      {"HeatKernelLaplacian", [](const FlatMesh& m) { (void)HeatKernelLaplacian(m, 1.); }},
  };
  return all;
}

TEST(DegenerateFaces, WithoutAreaAreNamedByEveryEntryPoint) {
  for (const double scale : kScales) {
    for (const Face& face : faces_without_area()) {
      const bool has_scale = face.name.find("doubles") != std::string::npos;
      if (has_scale && scale != 1) continue;
      OwnedMesh owned;
      const auto triangle = [&] {
        const VertexId a = owned.add_vertex(scale * Vec3(0, 0, 9)),
                       b = owned.add_vertex(scale * Vec3(1, 0, 9)),
                       c = owned.add_vertex(scale * Vec3(0, 1, 9));
        owned.add_face({a, b, c});
      };
      triangle();
      std::vector<VertexId> ids;
      for (Index i = 0; i < face.X.rows(); ++i)
        ids.push_back(owned.add_vertex(scale * face.X.row(i).transpose()));
      owned.add_face(ids);
      triangle();
      for (const Entry& entry : entries()) {
        const std::string what = std::string(entry.name) + " of " + face.name + " x " +
                                 std::to_string(std::log10(scale));
        try {
          entry.call(owned.view());
          ADD_FAILURE() << what << ": nothing was thrown";
        } catch (const InputError& error) {
          EXPECT_NE(std::string(error.what()).find("face 1 "), std::string::npos)
              << what << ": " << error.what();
        }
      }
    }
  }
}

TEST(DegenerateFaces, SurfelsBeyondDoublesAreRefusedByEveryEntryPoint) {
  for (const Vec3& scale : {Vec3(1e-170, 1e-170, 1e-170), Vec3(1e200, 1e200, 1e200),
                            Vec3(1e-200, 1e200, 1), Vec3(1, 1e-320, 1)}) {
    OwnedMesh mesh = testing::digital_family().front();
    mesh.spacing = mesh.spacing.cwiseProduct(scale);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      mesh.positions[i] *= scale[static_cast<Index>(i % 3)];
    }
    for (const Entry& entry : entries()) {
      EXPECT_THROW(entry.call(mesh.view()), InputError)
          << entry.name << " of " << scale.transpose();
    }
  }
}

TEST(DegenerateFaces, EveryFaceOfEveryFixtureKeepsTheLaws) {
  std::vector<OwnedMesh> meshes = testing::digital_family();
  meshes.push_back(meshes[2].as_polygons());
  for (unsigned seed = 1; seed < 6; ++seed) meshes.push_back(testing::polygon_soup(seed));
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    for (const double scale : kScales) {
      OwnedMesh mesh = meshes[m];
      for (double& x : mesh.positions) x *= scale;
      mesh.spacing *= scale;
      for (Index f = 0; f < mesh.view().faces(); ++f) {
        expect_laws(face_operators(mesh.view(), f),
                    "mesh " + std::to_string(m) + ", face " + std::to_string(f));
        if (HasFailure()) return;
      }
    }
  }
}

}  // namespace
}  // namespace dsc
