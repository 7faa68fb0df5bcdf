// What each mesh format allows, and what is refused, by small files written by hand.
#include "libdsc/io/mesh_reader.h"
#include "tests/io/temporary_folder.h"
#include "tests/io/volume_bytes.h"

#include <gtest/gtest.h>

#include <cstring>
#include <set>

namespace dsc {
namespace {

class MeshDialects : public testing::Test {
 protected:
  PolygonMesh read(const std::string& name, const std::string& text) {
    write_all(folder_ / name, text);
    return read_mesh(folder_ / name);
  }
  /// The file is refused by a message that names it and has all of `parts`.
  void refuse(const std::string& name, const std::string& text, std::vector<std::string> parts) {
    SCOPED_TRACE(text.substr(0, 200));
    parts.push_back(folder_ / name);
    expect_input_error([&] { (void)read(name, text); }, parts);
  }
  /// Whether a remark has `part`.
  static bool remarks(const PolygonMesh& mesh, const std::string& part) {
    for (const std::string& remark : mesh.remarks) {
      if (remark.find(part) != std::string::npos) return true;
    }
    return false;
  }

  TemporaryFolder folder_;
};

const std::vector<VertexId> kTriangle = {0, 1, 2};

TEST_F(MeshDialects, OffTakesCommentsBlankLinesAndColours) {
  const PolygonMesh mesh = read("a.off",
                                "# a comment\nOFF # and another\n\n3 2 5\r\n0 0 0 # here\n"
                                "+1 0 -.5e1\n\n0 1 0\n3 0 1 2 255 0 0\n3\t2 1 0\n# end");
  EXPECT_EQ(mesh.corners, (std::vector<VertexId>{0, 1, 2, 2, 1, 0}));
  EXPECT_EQ(mesh.positions(2, 1), -5.);
  EXPECT_TRUE(remarks(mesh, "colours of 1 face"));
  EXPECT_EQ(read("a.off", "OFF 3 1\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 ").corners, kTriangle);
}

TEST_F(MeshDialects, OffKeywordsSayWhatAVertexHas) {
  const PolygonMesh coloured =
      read("a.off", "COFF\n3 1 0\n0 0 0 1 1 1 1\n1 0 0 1 1 1 1\n0 1 0 1 1 1 1\n3 0 1 2\n");
  EXPECT_EQ(coloured.corners, kTriangle);
  EXPECT_TRUE(remarks(coloured, "colours"));
  const PolygonMesh normals =
      read("a.off", "NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 2\n0 1 0 0 0 3\n3 0 1 2\n");
  ASSERT_EQ(normals.fields.size(), 1U);
  EXPECT_EQ(normals.fields[0].name, "normal");
  EXPECT_EQ(normals.fields[0].values, (std::vector<double>{0, 0, 1, 0, 0, 2, 0, 0, 3}));
  refuse("a.off", "4OFF\n0 0 0\n", {"line 1", "'4OFF'"});
  refuse("a.off", "OFF BINARY\n", {"line 1", "binary OFF"});
}

TEST_F(MeshDialects, BrokenOffIsRefusedWithItsLine) {
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
  refuse("a.off", "", {"empty"});
  refuse("a.off", "solid\n", {"line 1", "keyword OFF"});
  refuse("a.off", "OFF\n3 x 0\n", {"line 2", "'x'"});
  refuse("a.off", "OFF\n3 1 0\n0 0 0\n1 0\n0 1 0\n3 0 1 2\n", {"line 4", "missing"});
  refuse("a.off", "OFF\n3 1 0\n0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n", {"line 4", "not a number"});
  refuse("a.off", "OFF\n3 1 0\n0 0 0\n1 0 -inf\n0 1 0\n3 0 1 2\n", {"line 4", "infinite"});
  refuse("a.off", "OFF\n3 1 0\n0 0 0\n1 0 1e999\n0 1 0\n3 0 1 2\n", {"line 4", "range"});
  refuse("a.off", "OFF\n3 1 0\n0 0 0 7\n1 0 0\n0 1 0\n3 0 1 2\n", {"line 3", "more than a vertex"});
  refuse("a.off", "OFF\n3 1 0\n" + points + "3 0 1 3\n", {"line 6", "corner 3", "3 vertices"});
  refuse("a.off", "OFF\n3 1 0\n" + points + "3 0 1 -1\n", {"line 6", "corner -1"});
  refuse("a.off", "OFF\n3 1 0\n" + points + "2 0 1\n", {"line 6", "2 corners"});
  refuse("a.off", "OFF\n3 1 0\n" + points + "3 0 1\n", {"line 6", "missing"});
  refuse("a.off", "OFF\n3 2 0\n" + points + "3 0 1 2\n", {"after face 1 of 2", "truncated"});
  refuse("a.off", "OFF\n3 1 0\n" + points + "3 0 1 2\n3 2 1 0\n", {"line 7", "goes on"});
}

TEST_F(MeshDialects, HeadersThatPromiseTooMuchFailAtOnce) {
  for (const char* count : {"1099511627776", "9223372036854775807", "2000000000"}) {
    const std::string n = count;
    refuse("a.off", "OFF\n3 " + n + " 0\n0 0 0\n", {"line 2", n, "truncated"});
    refuse("a.off", "OFF\n" + n + " 1 0\n0 0 0\n", {"line 2", n, "truncated"});
    for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
      const std::string start = std::string("ply\nformat ") + format + " 1.0\nelement vertex ";
      const std::string axes = "\nproperty float x\nproperty float y\nproperty float z\n";
      refuse("a.ply", start + n + axes + "end_header\n0 0 0\n", {n, "truncated"});
      refuse("a.ply",
             start + "0" + axes + "element face " + n +
                 "\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n",
             {n, "truncated"});
      refuse("a.ply",
             start + "0" + axes + "element hair " + n +
                 "\nproperty list uint float length\nend_header\n\1\1\1\1\1",
             {n, "truncated"});
    }
  }
  refuse("a.off", "OFF\n-1 0 0\n", {"line 2", "-1"});
}

TEST_F(MeshDialects, ObjTakesReferencesNegativeIndicesAndJoinedLines) {
  const PolygonMesh mesh = read("a.obj",
                                "# made by hand\nmtllib a.mtl\no thing\nv 0 0 0\nv 1 0 0 1.0\n"
                                "v 0 1 0 0.5 0.5 0.5\nvt 0 0\nvn 0 0 1\ng a b\nusemtl red\ns off\n"
                                "f 1/1/1 2/1/1 3/1/1\nf -1//1 -2//1 \\\n -3//1 # turned\n"
                                "v 1 1 0\nf 1/1 2/1 4/1 3/1\nl 1 2\n");
  EXPECT_EQ(mesh.corners, (std::vector<VertexId>{0, 1, 2, 2, 1, 0, 0, 1, 3, 2}));
  EXPECT_EQ(mesh.offsets, (std::vector<Index>{0, 3, 6, 10}));
  EXPECT_TRUE(remarks(mesh, "colours of 1 vertex"));
  EXPECT_TRUE(remarks(mesh, "1 line or point"));
}

TEST_F(MeshDialects, BrokenObjIsRefusedWithItsLine) {
  const std::string v = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  refuse("a.obj", "", {"no vertex"});
  refuse("a.obj", "v 0 0\n", {"line 1", "missing"});
  refuse("a.obj", "v 0 0 0\nv 0 0 nan\n", {"line 2", "not a number"});
  refuse("a.obj", "v 0 0 0 2\n", {"line 1", "weight"});
  refuse("a.obj", "v 0 0 0 2 3\n", {"line 1", "5 numbers"});
  refuse("a.obj", v + "f 1 2 4\n", {"line 4", "corner 4", "3 vertices"});
  refuse("a.obj", v + "f 1 2 0\n", {"line 4", "corner 0"});
  refuse("a.obj", v + "f 1 2 -4\n", {"line 4", "corner -4"});
  refuse("a.obj", v + "f 1 2\n", {"line 4", "2 corners"});
  refuse("a.obj", v + "f 1 2/ 3\n", {"line 4", "texture"});
  refuse("a.obj", v + "f 1 2 3x\n", {"line 4", "'3x'"});
  refuse("a.obj", v + "f 1 2 \\", {"line 4", "inside a statement"});
  refuse("a.obj", v + "curv 0 1 1 2\n", {"line 4", "'curv'"});
  refuse("a.obj", "# libdsc: 3 vertices, 2 faces\n" + v + "f 1 2 3\n", {"2 faces", "truncated"});
}

TEST_F(MeshDialects, TheLastLineNeedNotEnd) {
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
  const std::string v = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const std::vector<std::pair<std::string, std::string>> files = {
      {"a.off", "OFF\n3 1 0\n" + points + "3 0 1 2"},
      {"a.obj", v + "f 1 2 3"},
      {"a.ply", header + points + "3 0 1 2"}};
  for (const auto& [name, text] : files) {
    SCOPED_TRACE(name);
    const PolygonMesh mesh = read(name, text);
    EXPECT_EQ(mesh.corners, kTriangle);
    EXPECT_TRUE(remarks(mesh, "without a newline"));
    EXPECT_TRUE(read(name, text + "\n").remarks.empty());
    EXPECT_TRUE(read(name, text + " ").remarks.empty()) << "a blank ends a number too";
  }
  // Cut inside the face, the file is refused; a comment is not a number.
  refuse("a.off", "OFF\n3 1 0\n" + points + "3 0 1", {"line 6", "truncated"});
  refuse("a.obj", v + "f 1 2", {"line 4", "2 corners"});
  refuse("a.ply", header + points + "3 0 1", {"line 13", "truncated"});
  EXPECT_TRUE(read("a.obj", v + "f 1 2 3# done").remarks.empty());
  // Ours end in a newline.
  refuse("a.obj", "# libdsc: 3 vertices, 1 faces\n" + v + "f 1 2 3", {"line 5", "cut off"});
}

std::string ply(const std::string& format, const std::string& vertex, const std::string& face) {
  return "ply\nformat " + format + " 1.0\ncomment x\nobj_info y\nelement vertex 3\n" + vertex +
         "element face 1\n" + face + "end_header\n";
}
const std::string kAxes = "property float x\nproperty float y\nproperty float z\n";
const std::string kList = "property list uchar int vertex_indices\n";

template <class T>
void append(std::string& out, T value, bool big_endian) {
  char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);
  if (big_endian) std::reverse(bytes, bytes + sizeof value);
  out.append(bytes, sizeof value);
}

TEST_F(MeshDialects, PlyOfEveryTypeAndByteOrderIsRead) {
  for (const bool big : {false, true}) {
    std::string bytes =
        ply(big ? "binary_big_endian" : "binary_little_endian",
            "property int8 a\nproperty double x\nproperty short y\nproperty uint z\n"
            "property list ushort double w\nproperty uint8 b\n",
            "property uint16 label\nproperty list int8 uint32 vertex_index\n"
            "property float32 nx\nproperty float ny\nproperty float nz\n");
    for (int v = 0; v < 3; ++v) {
      append(bytes, static_cast<std::int8_t>(-v), big);
      append(bytes, 0.1 * v, big);
      append(bytes, static_cast<std::int16_t>(-300 * v), big);
      append(bytes, static_cast<std::uint32_t>(4000000000U + static_cast<unsigned>(v)), big);
      append(bytes, static_cast<std::uint16_t>(v), big);
      for (int i = 0; i < v; ++i) append(bytes, 1., big);
      append(bytes, static_cast<std::uint8_t>(200 + v), big);
    }
    append(bytes, std::uint16_t{65535}, big);
    append(bytes, std::int8_t{3}, big);
    for (const unsigned v : {2U, 0U, 1U}) append(bytes, static_cast<std::uint32_t>(v), big);
    for (const float n : {0.6F, 0.F, -0.8F}) append(bytes, n, big);
    const PolygonMesh mesh = read("a.ply", bytes);
    EXPECT_EQ(mesh.positions.col(2), Vec3(0.2, -600, 4000000002.));
    EXPECT_EQ(mesh.corners, (std::vector<VertexId>{2, 0, 1}));
    ASSERT_EQ(mesh.fields.size(), 3U);
    EXPECT_EQ(mesh.fields[0].values, (std::vector<double>{0, -1, -2}));
    EXPECT_EQ(mesh.fields[1].values, (std::vector<double>{200, 201, 202}));
    EXPECT_EQ(mesh.fields[2].values, (std::vector<double>{65535}));
    ASSERT_EQ(mesh.normals.cols(), 1);
    EXPECT_LT((mesh.normals.col(0) - Vec3(0.6, 0, -0.8)).norm(), 1e-7);
    EXPECT_NEAR(mesh.normals.col(0).norm(), 1, 1e-15);
    EXPECT_TRUE(remarks(mesh, "list w"));
    bytes.pop_back();
    refuse("a.ply", bytes, {"face 0", "truncated"});
    refuse("a.ply", bytes + "xyz", {"goes on", "2 bytes"});
  }
}

TEST_F(MeshDialects, PlyLeavesOutOtherElementsByName) {
  const PolygonMesh mesh = read(
      "a.ply",
      "ply\r\nformat ascii 1.0\r\nelement camera 1\r\nproperty float view_x\r\nelement vertex "
      "3\r\n" +
          kAxes + "element edge 2\nproperty int a\nelement face 1\n" + kList +
          "property uchar red\nproperty list uchar float texcoord\nend_header\n7\n0 0 0\n1 0 0\n"
          "0 1 0\n5\n6\n3 0 1 2 9 2 0.5 0.5\n");
  EXPECT_EQ(mesh.corners, kTriangle);
  EXPECT_TRUE(remarks(mesh, "1 elements camera") && remarks(mesh, "2 elements edge"));
  EXPECT_TRUE(remarks(mesh, "list texcoord"));
  ASSERT_EQ(mesh.fields.size(), 1U);
  EXPECT_EQ(mesh.fields[0].name, "red");
}

TEST_F(MeshDialects, FieldsThatCannotBeWrittenAreRenamedOrLeftOutByRemark) {
  const PolygonMesh mesh =
      read("a.ply", ply("ascii", kAxes + "property float a-b\nproperty float quality\n",
                        kList + "property float nx\nproperty float ny\nproperty float nz\n") +
                        "0 0 0 1 1\n1 0 0 2 nan\n0 1 0 3 3\n3 0 1 2 0 0 2\n");
  ASSERT_EQ(mesh.fields.size(), 2U);
  EXPECT_EQ(mesh.fields[0].name, "a_b");
  EXPECT_EQ(mesh.fields[1].name, "normal");
  EXPECT_EQ(mesh.normals.cols(), 0);
  EXPECT_TRUE(remarks(mesh, "'a-b'"));
  EXPECT_TRUE(remarks(mesh, "quality is not a number at vertex 1"));
  EXPECT_TRUE(remarks(mesh, "normal of face 0 is not a unit vector"));
  write_result(folder_ / "b.ply", mesh.result());
}

TEST_F(MeshDialects, ManyFieldsThatBecomeOneNameAreNumbered) {
  const std::string signs = "!#$%&*+-";
  std::string properties, zeros;
  for (const char a : signs) {
    for (const char b : signs) {
      for (const char c : signs) {
        for (const char d : signs) {
          properties += std::string("property float ") + a + b + c + d + "\n";
          zeros += " 0";
        }
      }
    }
  }
  const PolygonMesh mesh = read("a.ply", ply("ascii", kAxes + properties, kList) + "0 0 0" + zeros +
                                             "\n1 0 0" + zeros + "\n0 1 0" + zeros + "\n3 0 1 2\n");
  ASSERT_EQ(mesh.fields.size(), 4096U);
  std::set<std::string> names;
  for (const MeshField& field : mesh.fields) {
    EXPECT_LT(field.name.size(), 12U);
    names.insert(field.name);
  }
  EXPECT_EQ(names.size(), 4096U);
}

TEST_F(MeshDialects, ManyMorePropertiesThanAnyoneWritesAreRefused) {
  std::string properties;
  for (int i = 0; i < 10000; ++i) properties += "property float p" + std::to_string(i) + "\n";
  refuse("a.ply", ply("ascii", kAxes + properties, kList), {"10000 properties"});
}

TEST_F(MeshDialects, BrokenPlyIsRefusedWithItsLine) {
  const std::string good = ply("ascii", kAxes, kList);
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
  EXPECT_EQ(read("a.ply", good + points + "3 0 1 2\n").corners, kTriangle);
  refuse("a.ply", "plx\n", {"line 1", "not 'ply'"});
  refuse("a.ply", "ply\nformat ascii 2.0\n", {"line 2", "2.0"});
  refuse("a.ply", "ply\nformat binary 1.0\n", {"line 2", "'binary'"});
  refuse("a.ply", "ply\nelement vertex 3\nend_header\n", {"format"});
  refuse("a.ply", "ply\nformat ascii 1.0\nproperty float x\n", {"line 3", "before the first"});
  refuse("a.ply", "ply\nformat ascii 1.0\nelement vertex 0\nproperty real x\n",
         {"line 4", "'real'"});
  refuse("a.ply", "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float x\n",
         {"line 5", "twice"});
  refuse("a.ply", "ply\nformat ascii 1.0\nvertices 3\n", {"line 3", "'vertices'"});
  refuse("a.ply", ply("ascii", "property float x\nproperty float y\n", kList) + points,
         {"x, y or z"});
  refuse("a.ply", ply("ascii", kAxes, "property int a\n") + points + "3\n", {"vertex_indices"});
  refuse("a.ply",
         ply("ascii", kAxes, "property list uchar float vertex_indices\n") + points + "3 0 1 2\n",
         {"integer type"});
  refuse("a.ply", good + "0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n", {"line 13", "not finite"});
  refuse("a.ply", good + "0 0 0\n1 0 x\n0 1 0\n3 0 1 2\n", {"line 13", "'x'"});
  refuse("a.ply", good + "0 0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", {"line 12", "goes on"});
  refuse("a.ply", good + points + "3 0 1 3\n", {"line 15", "corner 3"});
  refuse("a.ply", good + points + "3 0 1 -1\n", {"line 15", "corner -1"});
  refuse("a.ply", good + points + "3 0 1 1.5\n", {"line 15", "integer"});
  refuse("a.ply", good + points + "2 0 1\n", {"line 15", "2 corners"});
  refuse("a.ply", good + points, {"truncated"});
  refuse("a.ply", good + points + "3 0 1 2\n0\n", {"line 16", "goes on"});
  std::string binary = ply("binary_little_endian", kAxes, kList);
  const std::string byte = "byte " + std::to_string(binary.size() + 20) + ":";  // z of vertex 1
  const float nan = std::nanf("");
  for (const float x : {0.F, 0.F, 0.F, 0.F, 0.F, nan, 0.F, 1.F, 0.F}) append(binary, x, false);
  refuse("a.ply", binary + "\3" + std::string(12, '\0'), {byte, "vertex 1", "not finite"});
}

std::string facet(const std::string& a, const std::string& b, const std::string& c) {
  return "facet normal 0 0 1\n outer loop\n  vertex " + a + "\n  vertex " + b + "\n  vertex " + c +
         "\n endloop\nendfacet\n";
}

TEST_F(MeshDialects, TextStlKeepsItsDigitsAndSharesEqualVertices) {
  const PolygonMesh mesh =
      read("a.stl", "solid of two\n" + facet("0 0 0", "1.00000000001 0 0", "0 1 0") +
                        facet("1.00000000001 -0 0", "1 1 0", "0 1 -0.0") + "endsolid of two\n\n");
  EXPECT_EQ(mesh.corners, (std::vector<VertexId>{0, 1, 2, 1, 3, 2}));
  EXPECT_EQ(mesh.positions(0, 1), 1.00000000001);
  const PolygonMesh both =
      read("a.stl", "SOLID\n" + facet("0 0 0", "1 0 0", "0 1 0") + "endsolid\nsolid b\n" +
                        facet("0 0 0", "0 0 0", "0 0 1") + "ENDSOLID b");
  EXPECT_EQ(both.corners.size(), 6U);
  EXPECT_TRUE(remarks(both, "1 triangle has two equal corners"));
}

TEST_F(MeshDialects, BrokenStlIsRefusedWithItsPlace) {
  const std::string one = facet("0 0 0", "1 0 0", "0 1 0");
  refuse("a.stl", "", {"too short"});
  refuse("a.stl", "solid a\n" + one, {"truncated"});
  refuse("a.stl", "solid a\n" + facet("0 0 0", "1 0 nan", "0 1 0") + "endsolid\n",
         {"line 5", "not a number"});
  refuse("a.stl", "solid a\n" + facet("0 0 0", "1 0", "0 1 0") + "endsolid\n",
         {"line 5", "missing"});
  refuse("a.stl", "solid a\nfacets\n", {"line 2", "'facets'"});
  refuse("a.stl", "solid a\n" + one + "endsolid\n" + one, {"line 10", "solid"});
  std::string binary(80, ' ');
  binary += little_endian(1, 4);
  std::string triangle(50, '\0');
  EXPECT_EQ(read("a.stl", binary + triangle).corners.size(), 3U);
  // A binary file may begin like a text.
  EXPECT_EQ(read("a.stl", "solid" + (binary + triangle).substr(5)).corners.size(), 3U);
  refuse("a.stl", binary + triangle + "x", {"too long"});
  refuse("a.stl", binary + triangle.substr(1), {"byte 80", "truncated"});
  const float infinity = std::numeric_limits<float>::infinity();
  std::memcpy(triangle.data() + 12, &infinity, 4);
  refuse("a.stl", binary + triangle, {"byte 84", "triangle 0", "not finite"});
}

TEST_F(MeshDialects, OmOfAnUnknownVersionIsRefused) {
  refuse("a.om", "", {"byte 0"});
  refuse("a.om", "PLY and something else", {"byte 0", "OM"});
  refuse("a.om", std::string("OMP\x20") + std::string(12, '\0'), {"byte 3", "version 1.0"});
  refuse("a.om",
         std::string("OMP\x42") + std::string(12, '\xff') + std::string("\0\x56", 2) +
             std::string(20, '\0'),
         {"truncated"});
}

}  // namespace
}  // namespace dsc
