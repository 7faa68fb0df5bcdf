// Meshes written and read back, by this library and by OpenMesh, and files cut at every byte.
#include "libdsc/io/mesh_reader.h"
#include "tests/io/sample_meshes.h"
#include "tests/io/temporary_folder.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>

#include <cstring>

namespace dsc {
namespace {

std::vector<std::uint64_t> bits_of(const double* values, Index n) {
  std::vector<std::uint64_t> bits(static_cast<std::size_t>(n));
  if (n > 0) std::memcpy(bits.data(), values, bits.size() * sizeof(double));
  return bits;
}
std::vector<std::uint64_t> bits_of(const Eigen::Matrix3Xd& m) {
  return bits_of(m.data(), m.size());
}
std::vector<std::uint64_t> bits_of(const std::vector<double>& v) {
  return bits_of(v.data(), std::ssize(v));
}

bool same_geometry(const PolygonMesh& a, const PolygonMesh& b) {
  return bits_of(a.positions) == bits_of(b.positions) && a.corners == b.corners &&
         a.offsets == b.offsets;
}

void expect_same_fields(const PolygonMesh& a, const PolygonMesh& b) {
  EXPECT_EQ(bits_of(a.normals), bits_of(b.normals));
  ASSERT_EQ(a.fields.size(), b.fields.size());
  for (const MeshField& field : a.fields) {
    const auto other = std::find_if(b.fields.begin(), b.fields.end(), [&](const MeshField& f) {
      return f.name == field.name && f.on == field.on;
    });
    ASSERT_NE(other, b.fields.end()) << field.name;
    EXPECT_EQ(other->parts, field.parts);
    EXPECT_EQ(bits_of(other->values), bits_of(field.values)) << field.name;
  }
}

PolygonMesh read_text(const TemporaryFolder& folder, const std::string& name,
                      const std::string& text) {
  write_all(folder / name, text);
  return read_mesh(folder / name);
}

TEST(MeshFiles, GeometryReadsBackToTheSameBits) {
  const TemporaryFolder folder;
  PolygonMesh empty;
  empty.offsets = {0};
  for (const std::string ending : {".off", ".obj", ".ply", ".om"}) {
    for (const PolygonMesh& mesh : {test::mixed_mesh(), test::junction_mesh(), empty}) {
      SCOPED_TRACE(ending + " of " + std::to_string(mesh.positions.cols()));
      write_result(folder / ("a" + ending), mesh.result());
      const PolygonMesh back = read_mesh(folder / ("a" + ending));
      EXPECT_TRUE(same_geometry(mesh, back));
      EXPECT_TRUE(back.fields.empty());
      EXPECT_EQ(back.remarks, std::vector<std::string>());
    }
  }
}

TEST(MeshFiles, LargeFilesReadBackToTheSameBits) {
  // More than one block of every reader.
  const TemporaryFolder folder;
  PolygonMesh mesh;
  test::set_random_positions(mesh, 40000, 4);
  std::mt19937 random(5);
  for (int f = 0; f < 50000; ++f) {
    const auto v = [&] { return static_cast<VertexId>(random() % 40000); };
    test::add_face(mesh, {v(), v(), v(), v(), v()});
  }
  test::add_random_fields(mesh, 6);
  for (const std::string ending : {".off", ".obj", ".ply"}) {
    write_result(folder / ("a" + ending), mesh.result());
    EXPECT_TRUE(same_geometry(mesh, read_mesh(folder / ("a" + ending)))) << ending;
  }
  expect_same_fields(mesh, read_mesh(folder / "a.ply"));
}

TEST(MeshFiles, FieldsAndNormalsReadBackToTheSameBits) {
  const TemporaryFolder folder;
  for (const std::string ending : {".ply", ".om"}) {
    for (PolygonMesh mesh : {test::mixed_mesh(), test::junction_mesh()}) {
      SCOPED_TRACE(ending);
      test::add_random_fields(mesh, 7);
      EXPECT_TRUE(write_result(folder / ("a" + ending), mesh.result()).empty());
      const PolygonMesh back = read_mesh(folder / ("a" + ending));
      EXPECT_TRUE(same_geometry(mesh, back));
      EXPECT_GT(back.normals.cols(), 0);
      expect_same_fields(mesh, back);
    }
  }
}

TEST(MeshFiles, FormsWithoutFieldsNameWhatTheyLeftOut) {
  const TemporaryFolder folder;
  PolygonMesh mesh = test::mixed_mesh();
  test::add_random_fields(mesh, 8);
  const std::vector<std::string> all = {"normal", "distance", "direction", "gradient", "heat"};
  for (const std::string ending : {".off", ".obj", ".stl"}) {
    EXPECT_EQ(write_result(folder / ("a" + ending), mesh.result()), all) << ending;
  }
}

TEST(MeshFiles, StlReadsBackToTheSameFloats) {
  const TemporaryFolder folder;
  const PolygonMesh mesh = test::float_triangles(30);
  write_result(folder / "a.stl", mesh.result());
  EXPECT_EQ(std::filesystem::file_size(folder / "a.stl"), 84U + 50U * 1800U);
  EXPECT_TRUE(same_geometry(mesh, read_mesh(folder / "a.stl")));
}

TEST(MeshFiles, StlCutsQuadsAlongTheirShorterDiagonalAndKeepsTheArea) {
  const TemporaryFolder folder;
  PolygonMesh mesh;
  mesh.positions.resize(3, 8);
  mesh.positions << 0, 4, 5, 1, 10, 11, 14, 11,  //
      0, 0, 1, 1, 0, -1, 0, 1,                   //
      0, 0, 0, 0, 0, 0, 0, 0;
  test::add_face(mesh, {0, 1, 2, 3});  // a rhomboid: 1 to 3 is shorter than 0 to 2
  test::add_face(mesh, {4, 5, 6, 7});  // a kite: 5 to 7 is shorter
  write_result(folder / "a.stl", mesh.result());
  const PolygonMesh back = read_mesh(folder / "a.stl");
  ASSERT_EQ(std::ssize(back.offsets) - 1, 4);
  EXPECT_EQ(back.positions.cols(), 8);
  double area = 0, up = 0;
  for (Index f = 0; f < 4; ++f) {
    const auto c = back.view().face(f);
    const Vec3 a = back.positions.col(c[0]), b = back.positions.col(c[1]),
               d = back.positions.col(c[2]);
    const Vec3 twice = (b - a).cross(d - a);
    area += twice.norm() / 2;
    up += twice.z() / 2;
    // No triangle has both ends of a longer diagonal.
    for (const auto& [p, q] :
         {std::pair{Vec3(0, 0, 0), Vec3(5, 1, 0)}, std::pair{Vec3(10, 0, 0), Vec3(14, 0, 0)}}) {
      int ends = 0;
      for (const Vec3& x : {a, b, d}) ends += (x == p || x == q) ? 1 : 0;
      EXPECT_LT(ends, 2);
    }
  }
  EXPECT_DOUBLE_EQ(area, 4 + 4);
  EXPECT_DOUBLE_EQ(up, area) << "a triangle is turned over";
}

/// Whether `part` is cut inside the last number, and says so.
bool says_it_ends_early(const PolygonMesh& part, const std::string& bytes, std::size_t n) {
  const std::size_t last_word = bytes.find_last_of(" \n", bytes.size() - 2);
  return n > last_word + 1 &&
         std::any_of(part.remarks.begin(), part.remarks.end(), [](const std::string& remark) {
           return remark.find("without a newline") != std::string::npos;
         });
}

/// A file cut anywhere is refused or gives all of the mesh; only inside the very last number of a
/// text without a count of bytes or lines nobody can tell, and a remark says so.
TEST(MeshFiles, CutAtAnyByteNothingIsHalfRead) {
  const TemporaryFolder folder;
  PolygonMesh mesh = test::mixed_mesh();
  test::add_random_fields(mesh, 9);
  PolygonMesh junction = test::junction_mesh();
  test::add_random_fields(junction, 10);
  const PolygonMesh triangles = test::float_triangles(2);
  std::string text_stl = "solid two\n";
  for (const char* z : {"0", "1"}) {
    text_stl += "facet normal 0 0 1\nouter loop\nvertex 0 0 " + std::string(z) +
                "\nvertex 1 0 0.5\nvertex 0 1e1 0\nendloop\nendfacet\n";
  }
  text_stl += "endsolid two\n";
  const std::string text_ply =
      "ply\nformat ascii 1.0\nelement vertex 13\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_index\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n1 1 1\n1 1 2\n1 1 3\n1 1 4\n1 1 5\n1 1 6\n1 1 7\n1 1 8\n1 1 9\n1 2 12\n"
      "4 0 1 2 12\n";
  const auto written = [&](const std::string& name, const PolygonMesh& m) {
    write_result(folder / name, m.result());
    return std::pair{name, read_all(folder / name)};
  };
  std::vector<std::pair<std::string, std::string>> files = {
      written("a.off", mesh), written("a.obj", mesh),    written("a.ply", mesh),
      written("a.om", mesh),  written("b.om", junction), written("a.stl", triangles),
      {"text.stl", text_stl}, {"text.ply", text_ply}};
  for (const auto& [name, bytes] : files) {
    SCOPED_TRACE(name);
    write_all(folder / name, bytes);
    const PolygonMesh whole = read_mesh(folder / name);
    std::size_t refused = 0, doubtful = 0;
    for (std::size_t n = 0; n < bytes.size(); ++n) {
      const std::string path = folder / ("cut_" + name);
      write_all(path, bytes.substr(0, n));
      try {
        const PolygonMesh part = read_mesh(path);
        if (says_it_ends_early(part, bytes, n)) {
          ++doubtful;
          continue;
        }
        ASSERT_TRUE(same_geometry(whole, part)) << "cut at byte " << n;
        expect_same_fields(whole, part);
      } catch (const InputError& error) {
        ++refused;
        const std::string what = error.what();
        EXPECT_NE(what.find(path), std::string::npos) << what;
        EXPECT_TRUE(what.find(", line ") != std::string::npos ||
                    what.find(", byte ") != std::string::npos)
            << what;
      }
    }
    EXPECT_GE(refused + 20, bytes.size());
    EXPECT_EQ(doubtful > 0, name == "a.off" || name == "text.ply");
  }
}

/// A byte changed anywhere is refused or gives some mesh whose corners are vertices: no crash.
TEST(MeshFiles, DamagedBytesAreHarmless) {
  const TemporaryFolder folder;
  PolygonMesh mesh = test::junction_mesh();
  test::add_random_fields(mesh, 11);
  std::mt19937 random(12);
  for (const std::string ending : {".off", ".obj", ".ply", ".om", ".stl"}) {
    const std::string path = folder / ("a" + ending);
    write_result(path, mesh.result());
    const std::string bytes = read_all(path);
    for (int round = 0; round < 300; ++round) {
      std::string damaged = bytes;
      for (int k = 0; k < 1 + round % 3; ++k) {
        damaged[random() % damaged.size()] = static_cast<char>(random());
      }
      write_all(path, damaged);
      try {
        const PolygonMesh read = read_mesh(path);
        ASSERT_TRUE(read.positions.allFinite());
        ASSERT_EQ(read.offsets.back(), std::ssize(read.corners));
        for (const VertexId v : read.corners) {
          ASSERT_GE(v, 0);
          ASSERT_LT(v, read.positions.cols());
        }
      } catch (const InputError&) {
      }
    }
  }
}

struct DoubleTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
};
using DoubleMesh = OpenMesh::PolyMesh_ArrayKernelT<DoubleTraits>;

TEST(MeshFiles, OpenMeshReadsWhatIsWritten) {
  const TemporaryFolder folder;
  const PolygonMesh mixed = test::mixed_mesh();
  for (const std::string ending : {".off", ".obj", ".ply", ".om"}) {
    const std::string path = folder / ("a" + ending);
    write_result(path, mixed.result());
    DoubleMesh mesh;
    ASSERT_TRUE(OpenMesh::IO::read_mesh(mesh, path)) << ending;
    ASSERT_EQ(mesh.n_vertices(), 11U) << ending;
    ASSERT_EQ(mesh.n_faces(), 4U) << ending;
    for (int v = 0; v < 11; ++v) {
      const auto& p = mesh.point(OpenMesh::VertexHandle(v));
      for (int k = 0; k < 3; ++k) {
        const double x = mixed.positions(k, v);
        EXPECT_NEAR(p[static_cast<std::size_t>(k)], x, 1e-6 * std::abs(x) + 1e-30) << ending;
      }
    }
    for (int f = 0; f < 4; ++f) {
      EXPECT_EQ(mesh.valence(OpenMesh::FaceHandle(f)), mixed.view().face(f).size()) << ending;
    }
  }
  const PolygonMesh triangles = test::float_triangles(5);
  write_result(folder / "a.stl", triangles.result());
  DoubleMesh mesh;
  ASSERT_TRUE(OpenMesh::IO::read_mesh(mesh, folder / "a.stl"));
  EXPECT_EQ(mesh.n_vertices(), 36U);
  EXPECT_EQ(mesh.n_faces(), 50U);
}

TEST(MeshFiles, WhatOpenMeshWritesIsRead) {
  const TemporaryFolder folder;
  OpenMesh::PolyMesh_ArrayKernelT<> mesh;
  std::vector<OpenMesh::VertexHandle> v;
  for (const auto& p :
       {OpenMesh::Vec3f(0, 0, 0), OpenMesh::Vec3f(1, 0, 0.25F), OpenMesh::Vec3f(1, 1, 0),
        OpenMesh::Vec3f(0, 1, 0), OpenMesh::Vec3f(2, 0, 0)}) {
    v.push_back(mesh.add_vertex(p));
  }
  mesh.add_face({v[0], v[1], v[2], v[3]});
  mesh.add_face(v[1], v[4], v[2]);
  OpenMesh::VPropHandleT<float> height;
  mesh.add_property(height, "height");
  mesh.property(height).set_persistent(true);
  for (const auto h : mesh.vertices()) mesh.property(height, h) = mesh.point(h)[2];
  for (const bool binary : {false, true}) {
    for (const std::string ending : {".off", ".obj", ".ply", ".om"}) {
      if (binary && (ending == ".off" || ending == ".obj")) continue;
      SCOPED_TRACE(ending);
      const std::string path = folder / ("a" + ending);
      ASSERT_TRUE(OpenMesh::IO::write_mesh(
          mesh, path, binary ? OpenMesh::IO::Options::Binary : OpenMesh::IO::Options::Default));
      const PolygonMesh read = read_mesh(path);
      EXPECT_EQ(read.positions.cols(), 5);
      EXPECT_EQ(read.corners, (std::vector<VertexId>{0, 1, 2, 3, 1, 4, 2}));
      EXPECT_EQ(read.offsets, (std::vector<Index>{0, 4, 7}));
      EXPECT_EQ(read.positions(2, 1), 0.25);
      if (ending != ".om") continue;
      ASSERT_EQ(read.fields.size(), 1U);
      EXPECT_EQ(read.fields[0].name, "height");
      EXPECT_EQ(read.fields[0].values, (std::vector<double>{0, 0.25, 0, 0, 0}));
    }
  }
}

/// Whatever OpenMesh can say of a mesh beside: none of it may disturb the rest.
TEST(MeshFiles, OmWithEveryAttributeIsReadAndTheRestIsNamed) {
  const TemporaryFolder folder;
  OpenMesh::PolyMesh_ArrayKernelT<> mesh;
  std::vector<OpenMesh::VertexHandle> v;
  for (int i = 0; i < 300; ++i) v.push_back(mesh.add_vertex({static_cast<float>(i), 1, 0}));
  for (std::size_t i = 1; i + 1 < v.size(); ++i) mesh.add_face(v[0], v[i], v[i + 1]);
  mesh.request_vertex_status();
  mesh.request_face_status();
  mesh.request_edge_status();
  mesh.request_halfedge_status();
  mesh.request_vertex_normals();
  mesh.request_face_normals();
  mesh.request_vertex_texcoords2D();
  OpenMesh::VPropHandleT<bool> flag;
  mesh.add_property(flag, "flag");
  mesh.property(flag).set_persistent(true);
  OpenMesh::FPropHandleT<std::string> word;
  mesh.add_property(word, "word");
  mesh.property(word).set_persistent(true);
  OpenMesh::FPropHandleT<OpenMesh::Vec3f> normal;
  mesh.add_property(normal, "dsc:normal");
  mesh.property(normal).set_persistent(true);
  for (const auto f : mesh.faces()) mesh.property(normal, f) = {0.6F, 0, 0.8F};
  using Options = OpenMesh::IO::Options;
  Options options = Options::Status;
  for (const auto o : {Options::VertexNormal, Options::FaceNormal, Options::VertexTexCoord}) {
    options += o;
  }
  ASSERT_TRUE(OpenMesh::IO::write_mesh(mesh, folder / "a.om", options));
  const PolygonMesh read = read_mesh(folder / "a.om");
  EXPECT_EQ(read.positions.cols(), 300);
  EXPECT_EQ(std::ssize(read.offsets) - 1, 298);
  ASSERT_EQ(read.normals.cols(), 298);
  EXPECT_NEAR(read.normals.col(7).norm(), 1., 1e-15) << "floats are normalised";
  std::string remarks;
  for (const std::string& remark : read.remarks) remarks += remark + "\n";
  for (const char* part :
       {"vertex normals", "face normals", "texture", "status", "'flag'", "'word'"}) {
    EXPECT_NE(remarks.find(part), std::string::npos) << part << " is not in " << remarks;
  }
}

TEST(MeshFiles, AJunctionSplitForOpenMeshIsGluedAgain) {
  const TemporaryFolder folder;
  const PolygonMesh junction = test::junction_mesh();
  write_result(folder / "a.om", junction.result());
  DoubleMesh mesh;
  ASSERT_TRUE(OpenMesh::IO::read_mesh(mesh, folder / "a.om"));
  EXPECT_EQ(mesh.n_faces(), 7U);
  EXPECT_GT(mesh.n_vertices(), 14U);
  EXPECT_EQ(read_mesh(folder / "a.om").positions.cols(), 14);
}

TEST(MeshFiles, EndingsInUpperCaseAreKnownAndOthersRefused) {
  const TemporaryFolder folder;
  EXPECT_EQ(read_text(folder, "a.OFF", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n").corners.size(),
            3U);
  EXPECT_TRUE(is_mesh_path("x/y.Ply"));
  EXPECT_FALSE(is_mesh_path("a.vtp"));
  EXPECT_THROW((void)read_mesh(folder / "a.dae"), UsageError);
  EXPECT_THROW((void)read_mesh(folder / "missing.off"), InputError);
}

}  // namespace
}  // namespace dsc
