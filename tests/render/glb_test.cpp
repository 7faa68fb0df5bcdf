// .glb: the file is taken apart by the words of glTF 2.0 and compared with the mesh.
#include "libdsc/render/glb_file.h"

#include "libdsc/base/error.h"
#include "libdsc/render/colormap.h"
#include "tests/io/temporary_folder.h"
#include "tests/io/volume_bytes.h"
#include "tests/render/meshes.h"

#include <gtest/gtest.h>
#include <Eigen/LU>
#include <nlohmann/json.hpp>

#include <cstring>
#include <limits>
#include <set>

namespace dsc {
namespace {

struct Glb {
  nlohmann::json json;
  std::string binary;

  explicit Glb(const std::string& path) {
    const std::string bytes = read_all(path);
    EXPECT_EQ(bytes.substr(0, 4), "glTF");
    EXPECT_EQ(word(bytes, 4), 2U);
    EXPECT_EQ(word(bytes, 8), bytes.size());
    const std::size_t text = word(bytes, 12);
    EXPECT_EQ(text % 4, 0U);
    EXPECT_EQ(bytes.substr(16, 4), "JSON");
    json = nlohmann::json::parse(bytes.substr(20, text));
    EXPECT_EQ(bytes.substr(24 + text, 4), std::string("BIN\0", 4));
    binary = bytes.substr(28 + text);
    EXPECT_EQ(word(bytes, 20 + text), binary.size());
    EXPECT_EQ(json["buffers"][0]["byteLength"], binary.size());
  }
  static std::uint32_t word(const std::string& bytes, std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, 4);
    return value;
  }
  const nlohmann::json& attributes() const {
    return json["meshes"][0]["primitives"][0]["attributes"];
  }
  template <class T>
  std::vector<T> values(int accessor, std::size_t components) const {
    const auto& a = json["accessors"].at(static_cast<std::size_t>(accessor));
    const auto& view = json["bufferViews"].at(a["bufferView"].get<std::size_t>());
    std::vector<T> all(a["count"].get<std::size_t>() * components);
    EXPECT_EQ(view["byteLength"], all.size() * sizeof(T));
    std::memcpy(all.data(), binary.data() + view["byteOffset"].get<std::size_t>(),
                all.size() * sizeof(T));
    return all;
  }
  std::vector<float> floats(const char* name, std::size_t components) const {
    return values<float>(attributes().at(name).get<int>(), components);
  }
  std::vector<std::uint32_t> triangles() const {
    return values<std::uint32_t>(json["meshes"][0]["primitives"][0]["indices"].get<int>(), 1);
  }
};

TEST(Glb, HoldsASurfaceWithItsColoursAndValues) {
  const TemporaryFolder folder;
  test::OwnMesh mesh = test::sphere(12);
  const Vec3 far(1e6, -2e6, 3e6);  // where floats are a quarter apart
  mesh.positions.colwise() += far;
  Eigen::VectorXd height(mesh.positions.cols());
  for (Index v = 0; v < height.size(); ++v) height[v] = mesh.positions(2, v) - far[2];
  const Field field = scalar_field("height", FieldOn::vertex, height);
  EXPECT_TRUE(render::write_glb(folder / "s.glb", {mesh.view(), {field}}).empty());

  const Glb glb(folder / "s.glb");
  const auto positions = glb.floats("POSITION", 3), values = glb.floats("_HEIGHT", 1);
  const auto normals = glb.floats("NORMAL", 3);
  const auto colours = glb.values<std::uint16_t>(glb.attributes()["COLOR_0"].get<int>(), 4);
  const auto shift = glb.json["nodes"][0]["translation"].get<std::vector<double>>();
  ASSERT_EQ(positions.size(), 3U * static_cast<std::size_t>(height.size()));
  const render::Colormap polar("polar");  // the heights have both signs
  for (std::size_t v = 0; v < values.size(); ++v) {
    const auto at = static_cast<Index>(v);
    EXPECT_EQ(values[v], static_cast<float>(height[at]));
    const render::Rgb colour = polar(0.5 + 0.5 * height[at]);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Index>(k);
      EXPECT_NEAR(positions[3 * v + k] + shift[k], mesh.positions(axis, at), 1e-6);
      EXPECT_NEAR(colours[4 * v + k] / 65535., std::clamp(colour[axis], 0., 1.), 1e-5);
      EXPECT_NEAR(normals[3 * v + k], mesh.positions(axis, at) - far[axis], 0.05);
    }
  }
  // The triangles enclose the volume of the polyhedron, close to that of the ball.
  const auto triangles = glb.triangles();
  double volume = 0;
  for (std::size_t t = 0; t < triangles.size(); t += 3) {
    Mat3 corners;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        corners(static_cast<Index>(k), static_cast<Index>(i)) = positions[3 * triangles[t + i] + k];
      }
    }
    volume += corners.determinant() / 6;
  }
  EXPECT_NEAR(volume, 4 * std::numbers::pi / 3, 0.15);
}

TEST(Glb, FacesWithValuesHaveCornersOfTheirOwn) {
  const TemporaryFolder folder;
  const test::OwnMesh box = test::box(Vec3(0, 0, 0), Vec3(1, 2, 3));
  const Eigen::VectorXd numbers = Eigen::VectorXd::LinSpaced(6, 0, 5);
  Eigen::VectorXd distance = Eigen::VectorXd::Ones(8);
  distance[3] = std::numeric_limits<double>::infinity();
  const Eigen::Matrix3Xd arrows = Eigen::Matrix3Xd::Ones(3, 6);
  const std::vector<std::string> left_out = render::write_glb(
      folder / "b.glb",
      {box.view(),
       {vector_field("arrow", {"ax", "ay", "az"}, FieldOn::face, {arrows.data(), arrows.cols()}),
        scalar_field("number", FieldOn::face, numbers),
        scalar_field("distance", FieldOn::vertex, distance)}});
  EXPECT_EQ(left_out, (std::vector<std::string>{"arrow", "distance"}));

  const Glb glb(folder / "b.glb");
  const auto normals = glb.floats("NORMAL", 3);
  const auto colours = glb.values<std::uint16_t>(glb.attributes()["COLOR_0"].get<int>(), 4);
  ASSERT_EQ(normals.size(), 3U * 24);
  EXPECT_EQ(glb.triangles().size(), 6U * 6);
  const render::Colormap lagoon("lagoon");
  std::set<std::vector<float>> directions;
  for (std::size_t p = 0; p < 24; ++p) {
    const render::Rgb colour = lagoon(static_cast<double>(p / 4) / 5);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(colours[4 * p + k] / 65535., std::clamp(colour[static_cast<Index>(k)], 0., 1.),
                  1e-5);
    }
    directions.insert({normals[3 * p], normals[3 * p + 1], normals[3 * p + 2]});
  }
  EXPECT_EQ(directions.size(), 6U);
  EXPECT_EQ(glb.attributes().count("_DISTANCE"), 0U);  // glTF has no infinity
}

TEST(Glb, WhatItCannotHoldIsRefusedAndLeavesTheFile) {
  const TemporaryFolder folder;
  const std::string path = folder / "b.glb";
  const test::OwnMesh box = test::box(Vec3(0, 0, 0), Vec3(1, 2, 3));
  render::write_glb(path, {box.view(), {}});
  const std::string before = read_all(path);
  EXPECT_THROW(render::write_glb(path, {}), InputError);
  test::OwnMesh vast = box;
  vast.positions(0, 2) = 1e39;
  EXPECT_THROW(render::write_glb(path, {vast.view(), {}}), InputError);
  Eigen::VectorXd bad = Eigen::VectorXd::Zero(8);
  bad[2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(render::write_glb(path, {box.view(), {scalar_field("bad", FieldOn::vertex, bad)}}),
               InputError);
  const std::vector<double> short_field(7);
  EXPECT_THROW(
      render::write_glb(path, {box.view(), {scalar_field("f", FieldOn::vertex, short_field)}}),
      UsageError);
  test::OwnMesh broken = box;
  broken.corners[5] = 8;
  EXPECT_THROW(render::write_glb(path, {broken.view(), {}}), InputError);
  EXPECT_EQ(read_all(path), before);
}

TEST(Glb, NamesThatDifferInCaseOnlyAreBothThere) {
  const TemporaryFolder folder;
  const test::OwnMesh box = test::box(Vec3(0, 0, 0), Vec3(1, 2, 3));
  const Eigen::VectorXd low = Eigen::VectorXd::Constant(8, 1), high = 2 * low, third = 3 * low;
  render::write_glb(folder / "b.glb", {box.view(),
                                       {scalar_field("heat", FieldOn::vertex, low),
                                        scalar_field("Heat", FieldOn::vertex, high),
                                        scalar_field("heat_2", FieldOn::vertex, third)}});
  const Glb glb(folder / "b.glb");
  EXPECT_EQ(glb.floats("_HEAT", 1)[3], 1);
  EXPECT_EQ(glb.floats("_HEAT_2", 1)[3], 2);
  EXPECT_EQ(glb.floats("_HEAT_2_2", 1)[3], 3);
}

}  // namespace
}  // namespace dsc
