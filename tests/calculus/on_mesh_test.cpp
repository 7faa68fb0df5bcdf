#include "libdsc/calculus/on_mesh.h"

#include "libdsc/calculus/face_operators.h"
#include "tests/calculus/meshes.h"

#include <gtest/gtest.h>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include <cmath>
#include <map>

namespace dsc {
namespace {

struct FloatTraits : OpenMesh::DefaultTraits {
  VertexAttributes(OpenMesh::Attributes::Status);
  EdgeAttributes(OpenMesh::Attributes::Status);
  FaceAttributes(OpenMesh::Attributes::Status);
};
struct DoubleTraits : OpenMesh::DefaultTraitsDouble {
  VertexTraits { int mark = 0; };
};
using FloatTriangles = OpenMesh::TriMesh_ArrayKernelT<FloatTraits>;
using DoubleTriangles = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;
using FloatPolygons = OpenMesh::PolyMesh_ArrayKernelT<FloatTraits>;
using DoublePolygons = OpenMesh::PolyMesh_ArrayKernelT<DoubleTraits>;

/// An octahedron, its triangles cut in four `levels` times, pushed onto an ellipsoid.
template <class Mesh>
Mesh ellipsoid(int levels) {
  std::vector<Vec3> points{Vec3::UnitX(),  -Vec3::UnitX(), Vec3::UnitY(),
                           -Vec3::UnitY(), Vec3::UnitZ(),  -Vec3::UnitZ()};
  std::vector<std::array<int, 3>> faces{{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                        {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [it, fresh] =
          middles.try_emplace(std::minmax(a, b), static_cast<int>(points.size()));
      if (fresh) {
        points.push_back((points[static_cast<std::size_t>(a)] + points[static_cast<std::size_t>(b)])
                             .normalized());
      }
      return it->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : faces) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    faces = finer;
  }
  Mesh mesh;
  std::vector<OpenMesh::VertexHandle> handles;
  for (const Vec3& p : points) {
    using Scalar = typename Mesh::Scalar;
    handles.push_back(mesh.add_vertex(typename Mesh::Point(static_cast<Scalar>(p.x()),
                                                           static_cast<Scalar>(1.5 * p.y()),
                                                           static_cast<Scalar>(0.7 * p.z()))));
  }
  for (const auto& f : faces) {
    mesh.add_face(handles[static_cast<std::size_t>(f[0])], handles[static_cast<std::size_t>(f[1])],
                  handles[static_cast<std::size_t>(f[2])]);
  }
  return mesh;
}

/// The cotangent Laplacian, from angles at the halfedges: ½ (cot α + cot β) at each edge.
template <class Mesh>
Eigen::MatrixXd cotangent_laplacian(const Mesh& mesh) {
  const auto n = static_cast<Index>(mesh.n_vertices());
  Eigen::MatrixXd L = Eigen::MatrixXd::Zero(n, n);
  for (const auto h : mesh.halfedges()) {
    if (h.is_boundary()) continue;
    const auto at = [&](OpenMesh::VertexHandle v) {
      const auto& p = mesh.point(v);
      return Vec3(p[0], p[1], p[2]);
    };
    const Index a = h.from().idx(), b = h.to().idx();
    const Vec3 apex = at(h.next().to());
    const Vec3 p = at(h.from()) - apex, q = at(h.to()) - apex;
    const double cotangent = std::cos(std::acos(p.dot(q) / p.norm() / q.norm())) /
                             std::sin(std::acos(p.dot(q) / p.norm() / q.norm()));
    L(a, b) += 0.5 * cotangent;
    L(b, a) += 0.5 * cotangent;
    L(a, a) -= 0.5 * cotangent;
    L(b, b) -= 0.5 * cotangent;
  }
  return L;
}

template <class Mesh>
class OnTriangles : public ::testing::Test {};
using TriangleMeshes =
    ::testing::Types<FloatTriangles, DoubleTriangles, FloatPolygons, DoublePolygons>;
TYPED_TEST_SUITE(OnTriangles, TriangleMeshes);

/// On triangles P D = 0, so λ does not matter and the Laplacian is the cotangents'.
TYPED_TEST(OnTriangles, LaplacianIsTheCotangentOneForEveryLambda) {
  auto mesh = ellipsoid<TypeParam>(2);
  for (const double lambda : {0.25, 10.}) {
    const Eigen::MatrixXd L = calculus_on_mesh(mesh, {}, {lambda}).laplacian();
    const Eigen::MatrixXd expected = cotangent_laplacian(mesh);
    EXPECT_LT((L - expected).norm(), 1e-11 * expected.norm());
  }
}

TYPED_TEST(OnTriangles, MassIsAThirdOfTheTrianglesAround) {
  auto mesh = ellipsoid<TypeParam>(1);
  const Eigen::VectorXd mass = calculus_on_mesh(mesh).laplace_system().mass;
  for (const auto v : mesh.vertices()) {
    double area = 0.;
    for (const auto h : v.outgoing_halfedges()) {
      const auto at = [&](OpenMesh::VertexHandle w) {
        const auto& p = mesh.point(w);
        return Vec3(p[0], p[1], p[2]);
      };
      area += 0.5 * (at(h.to()) - at(v)).cross(at(h.next().to()) - at(v)).norm();
    }
    EXPECT_NEAR(mass[v.idx()], area / 3., 1e-13);
  }
}

/// A hexagonal prism with a bent cap, a quadrilateral mantle and a cap of triangles.
template <class Mesh>
Mesh prism() {
  Mesh mesh;
  using Scalar = typename Mesh::Scalar;
  std::vector<OpenMesh::VertexHandle> ring[2];
  for (int z = 0; z < 2; ++z) {
    for (int i = 0; i < 6; ++i) {
      const double angle = M_PI * i / 3.;
      ring[z].push_back(mesh.add_vertex(typename Mesh::Point(
          static_cast<Scalar>(std::cos(angle)), static_cast<Scalar>(std::sin(angle)),
          static_cast<Scalar>(z + 0.2 * z * (i % 2)))));
    }
  }
  const auto tip = mesh.add_vertex(typename Mesh::Point(0, 0, -1));
  mesh.add_face(ring[1]);
  for (std::size_t i = 0; i < 6; ++i) {
    const std::size_t j = (i + 1) % 6;
    mesh.add_face({ring[0][i], ring[0][j], ring[1][j], ring[1][i]});
    mesh.add_face({ring[0][j], ring[0][i], tip});
  }
  return mesh;
}

/// Sums the reference over the faces, read through OpenMesh's circulators.
template <class Mesh, class NormalOf>
Eigen::MatrixXd reference_laplacian(const Mesh& mesh, NormalOf&& normal_of) {
  const auto V = static_cast<Index>(mesh.n_vertices());
  Eigen::MatrixXd L = Eigen::MatrixXd::Zero(V, V);
  for (const auto f : mesh.faces()) {
    std::vector<int> ids;
    for (const auto v : mesh.fv_range(f)) ids.push_back(v.idx());
    FaceOperators::Corners X(static_cast<Index>(ids.size()), 3);
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const auto& p = mesh.point(OpenMesh::VertexHandle(ids[i]));
      X.row(static_cast<Index>(i)) << p[0], p[1], p[2];
    }
    const Eigen::MatrixXd local = FaceOperators(X, normal_of(f)).laplacian();
    for (std::size_t i = 0; i < ids.size(); ++i) {
      for (std::size_t j = 0; j < ids.size(); ++j) {
        L(ids[i], ids[j]) += local(static_cast<Index>(i), static_cast<Index>(j));
      }
    }
  }
  return L;
}

TEST(OnMesh, NgonsWithTheirNormalPropertyGiveTheFacesSum) {
  auto mesh = prism<FloatPolygons>();
  OpenMesh::FPropHandleT<OpenMesh::Vec3f> property;
  mesh.add_property(property, "my normals");
  mesh.request_face_normals();
  mesh.update_face_normals();
  for (const auto f : mesh.faces()) {
    mesh.property(property, f) = (mesh.normal(f) + OpenMesh::Vec3f(0.2f, 0.1f, 0.3f)).normalized();
  }
  MeshProperties names;
  names.normals = "my normals";
  const MeshCalculus calculus = calculus_on_mesh(mesh, names);
  const Eigen::MatrixXd L = calculus.laplacian();
  const Eigen::MatrixXd expected = reference_laplacian(mesh, [&](OpenMesh::FaceHandle f) {
    const auto& u = mesh.property(property, f);
    return Vec3(Vec3(u[0], u[1], u[2]).normalized());
  });
  EXPECT_LT((L - expected).norm(), 1e-12 * expected.norm());
  const Eigen::MatrixXd composed = calculus.divergence() * calculus.difference();
  EXPECT_LT((L - composed).norm(), 1e-12 * expected.norm());
  EXPECT_EQ(calculus.mass1().rows(), 6 + 6 * 7);

  // Unnamed, the property is not looked for: the naive calculus.
  const Eigen::MatrixXd naive = calculus_on_mesh(mesh).laplacian();
  EXPECT_GT((naive - expected).norm(), 1e-3 * expected.norm());
}

TEST(OnMesh, UsualPropertiesAreFoundUnlessDeclined) {
  auto mesh = prism<DoublePolygons>();
  const Eigen::MatrixXd naive = calculus_on_mesh(mesh).laplacian();
  OpenMesh::FPropHandleT<OpenMesh::Vec3d> normals;
  mesh.add_property(normals, "dsc:normal");
  mesh.request_face_normals();
  mesh.update_face_normals();
  for (const auto f : mesh.faces()) {
    mesh.property(normals, f) = (mesh.normal(f) + OpenMesh::Vec3d(0.2, 0.1, 0.3)).normalized();
  }
  const Eigen::MatrixXd projected = calculus_on_mesh(mesh).laplacian();
  const Eigen::MatrixXd expected = reference_laplacian(mesh, [&](OpenMesh::FaceHandle f) {
    const auto& u = mesh.property(normals, f);
    return Vec3(u[0], u[1], u[2]);
  });
  EXPECT_LT((projected - expected).norm(), 1e-12 * expected.norm());
  MeshProperties none;
  none.normals = "";
  EXPECT_EQ(Eigen::MatrixXd(calculus_on_mesh(mesh, none).laplacian()), naive);
}

/// Two tetrahedra that touch in one vertex: the mesh has it twice, the table once.
template <class Table, class Fill>
void expect_glued(Fill&& fill) {
  DoublePolygons mesh;
  const auto add = [&](double x, double y, double z) { return mesh.add_vertex({x, y, z}); };
  std::vector<OpenMesh::VertexHandle> v{add(0, 0, 0),  add(1, 0, 0),  add(0, 1, 0),  add(0, 0, 1),
                                        add(-1, 0, 0), add(0, -1, 0), add(0, 0, -1), add(0, 0, 0)};
  const int faces[8][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3},
                           {7, 4, 5}, {7, 6, 4}, {7, 5, 6}, {4, 6, 5}};
  OpenMesh::FPropHandleT<Table> table;
  mesh.add_property(table, "dsc:corners");
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(7, 7);
  for (const auto& f : faces) {
    const auto face =
        mesh.add_face({v[static_cast<std::size_t>(f[0])], v[static_cast<std::size_t>(f[1])],
                       v[static_cast<std::size_t>(f[2])]});
    fill(mesh.property(table, face), f[0] % 7, f[1] % 7, f[2] % 7);
    FaceOperators::Corners X(3, 3);
    for (int i = 0; i < 3; ++i) {
      const auto& p = mesh.point(v[static_cast<std::size_t>(f[i])]);
      X.row(i) << p[0], p[1], p[2];
    }
    const Eigen::MatrixXd local = FaceOperators(X).laplacian();
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) expected(f[i] % 7, f[j] % 7) += local(i, j);
    }
  }
  const Eigen::MatrixXd L = calculus_on_mesh(mesh).laplacian();
  ASSERT_EQ(L.rows(), 7);
  EXPECT_LT((L - expected).norm(), 1e-13);
  MeshProperties own;
  own.corners = "";
  EXPECT_EQ(calculus_on_mesh(mesh, own).laplacian().rows(), 8);
}

TEST(OnMesh, CornerTableGluesWhatTheMeshHasSplit) {
  expect_glued<std::vector<int>>([](auto& row, int a, int b, int c) { row = {a, b, c}; });
  expect_glued<std::array<std::int32_t, 3>>([](auto& row, int a, int b, int c) {
    row = {a, b, c};
  });
}

TEST(OnMesh, QuadTableOfDigitalSurfacesIsRead) {
  DoublePolygons mesh;
  std::vector<OpenMesh::VertexHandle> v;
  for (const auto& [x, y] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
    v.push_back(mesh.add_vertex(DoublePolygons::Point(x, y, 0)));
  }
  OpenMesh::FPropHandleT<std::array<VertexId, 4>> table;
  mesh.add_property(table, "dsc:corners");
  mesh.property(table, mesh.add_face(v)) = {1, 2, 3, 0};
  const Eigen::MatrixXd L = calculus_on_mesh(mesh).laplacian();
  EXPECT_NEAR(L(0, 2), 0.5 - 0.25, 1e-15);
  mesh.property(table, OpenMesh::FaceHandle(0))[2] = 4;
  EXPECT_THROW(calculus_on_mesh(mesh), InputError);
}

TEST(OnMesh, AbsentPropertiesAskedForByNameAreRefused) {
  auto mesh = prism<DoublePolygons>();
  MeshProperties names;
  names.normals = "no such thing";
  EXPECT_THROW(calculus_on_mesh(mesh, names), UsageError);
  names = {};
  names.corners = "no such thing";
  EXPECT_THROW(calculus_on_mesh(mesh, names), UsageError);
  // There, but of a type that holds no vertex ids.
  OpenMesh::FPropHandleT<double> other;
  mesh.add_property(other, "no such thing");
  EXPECT_THROW(calculus_on_mesh(mesh, names), UsageError);
}

TEST(OnMesh, TablesAndNormalsThatDoNotFitAreRefused) {
  auto mesh = prism<DoublePolygons>();
  OpenMesh::FPropHandleT<std::vector<int>> table;
  mesh.add_property(table, "dsc:corners");
  EXPECT_THROW(calculus_on_mesh(mesh), InputError);  // empty rows
  mesh.remove_property(table);
  OpenMesh::FPropHandleT<OpenMesh::Vec3d> normals;
  mesh.add_property(normals, "dsc:normal");
  for (const auto f : mesh.faces()) mesh.property(normals, f) = OpenMesh::Vec3d(0, 0, 2);
  EXPECT_THROW(calculus_on_mesh(mesh), InputError);
}

TEST(OnMesh, DeletedElementsAreRefusedUntilCollected) {
  auto mesh = ellipsoid<FloatPolygons>(1);
  mesh.delete_face(OpenMesh::FaceHandle(3));
  EXPECT_THROW(calculus_on_mesh(mesh), UsageError);
  mesh.garbage_collection();
  const Eigen::MatrixXd expected = cotangent_laplacian(mesh);
  const Eigen::MatrixXd L = calculus_on_mesh(mesh).laplacian();
  EXPECT_LT((L - expected).norm(), 1e-11 * expected.norm());
}

}  // namespace
}  // namespace dsc
