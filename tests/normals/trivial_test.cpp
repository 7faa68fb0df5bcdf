#include "libdsc/normals/trivial.h"

#include "libdsc/base/error.h"
#include "tests/normals/normals_support.h"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <set>

namespace dsc {
namespace {

/// Surfels with their corners glued by pointel, by a dictionary of positions.
struct Quads {
  std::vector<Surfel> surfels;
  std::vector<VertexId> corners;
  std::vector<double> positions;

  explicit Quads(const BinaryVolume& volume) : surfels(test::all_surfels(volume)) {
    std::map<std::array<int, 3>, VertexId> ids;
    for (const Surfel& s : surfels) {
      const SurfelFrame frame = kSurfelFrames[s.direction];
      for (const auto& [a, b] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
        std::array<int, 3> p{2 * s.x, 2 * s.y, 2 * s.z};
        p[static_cast<std::size_t>(s.axis())] += s.sign();
        p[static_cast<std::size_t>(frame.first)] += 2 * a - 1;
        p[static_cast<std::size_t>(frame.second)] += 2 * b - 1;
        const auto [it, is_new] = ids.try_emplace(p, static_cast<VertexId>(ids.size()));
        if (is_new) positions.insert(positions.end(), {p[0] / 2., p[1] / 2., p[2] / 2.});
        corners.push_back(it->second);
      }
    }
  }
  FlatMesh mesh(bool digital) const {
    FlatMesh m;
    m.positions = {positions.data(), static_cast<Index>(positions.size() / 3)};
    m.corners = corners;
    if (digital) m.surfels = surfels;
    return m;
  }
};

TEST(TrivialNormals, AreTheMeanOverFacesThatShareAVertex) {
  const Quads quads(test::random_volume(Grid{{7, 6, 5}}, 0.4, 1));
  const FlatMesh mesh = quads.mesh(true);
  const NormalField field = trivial_normals(mesh);
  Index fallbacks = 0;
  for (Index f = 0; f < mesh.faces(); ++f) {
    const std::set<VertexId> mine(mesh.face(f).begin(), mesh.face(f).end());
    Vec3 sum = Vec3::Zero();
    for (Index g = 0; g < mesh.faces(); ++g) {
      bool shares = false;
      for (const VertexId v : mesh.face(g)) shares = shares || mine.count(v) > 0;
      if (shares) sum += quads.surfels[static_cast<std::size_t>(g)].normal();
    }
    const Vec3 own = quads.surfels[static_cast<std::size_t>(f)].normal();
    if (sum.dot(own) > 0) {
      EXPECT_LT((field.u.col(f) - sum.normalized()).norm(), 1e-14);
    } else {
      EXPECT_EQ(field.u.col(f), own);
      ++fallbacks;
    }
  }
  EXPECT_EQ(field.fallbacks, fallbacks);
  EXPECT_EQ(field.radius, 0);
}

TEST(TrivialNormals, AgreeBetweenSurfelsAndTheirPolygons) {
  const Quads quads(test::digital_sphere(1, 0.15));
  const NormalField surfels = trivial_normals(quads.mesh(true));
  const NormalField polygons = trivial_normals(quads.mesh(false));
  EXPECT_LT((surfels.u - polygons.u).norm(), 1e-12);
}

TEST(TrivialNormals, PointOutOfASphereOnAverage) {
  const BinaryVolume volume = test::digital_sphere(1, 0.1);
  const Quads quads(volume);
  const NormalField field = trivial_normals(quads.mesh(true));
  EXPECT_EQ(field.fallbacks, 0);
  double own = 0, averaged = 0;
  for (std::size_t i = 0; i < quads.surfels.size(); ++i) {
    const Vec3 truth = quads.surfels[i].centre(volume.grid()).normalized();
    own += (quads.surfels[i].normal() - truth).norm();
    averaged += (field.u.col(static_cast<Index>(i)) - truth).norm();
  }
  EXPECT_LT(averaged, 0.5 * own);
}

TEST(TrivialNormals, FallBackWhereTheSumVanishes) {
  // One quad and its reverse.
  const std::vector<double> positions{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  const std::vector<VertexId> corners{0, 1, 2, 3, 3, 2, 1, 0};
  FlatMesh mesh;
  mesh.positions = {positions.data(), 4};
  mesh.corners = corners;
  const NormalField field = trivial_normals(mesh);
  EXPECT_EQ(field.fallbacks, 2);
  EXPECT_EQ(field.u.col(0), Vec3(0, 0, 1));
  EXPECT_EQ(field.u.col(1), Vec3(0, 0, -1));
}

TEST(TrivialNormals, RefuseAFaceWithoutAnyArea) {
  const std::vector<double> positions{0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0};
  const std::vector<VertexId> corners{0, 1, 2, 3};
  FlatMesh mesh;
  mesh.positions = {positions.data(), 4};
  mesh.corners = corners;
  EXPECT_THROW(trivial_normals(mesh), InputError);
}

TEST(TrivialNormals, HaveTheSameBitsForAnyThreadCount) {
  const Quads quads(test::digital_sphere(1, 0.02));
  for (const bool digital : {false, true}) {
    const FlatMesh mesh = quads.mesh(digital);
    ASSERT_GT(mesh.faces(), 4 << 13);  // chunks of 8192 faces
    const NormalField one = trivial_normals(mesh, {1, nullptr});
    for (const int threads : {2, 4, 8}) {
      EXPECT_EQ(trivial_normals(mesh, {threads, nullptr}).u, one.u);
    }
  }
}

}  // namespace
}  // namespace dsc
