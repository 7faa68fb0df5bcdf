// Pages as a person uses them: windows of any size, keys, fingers, every control.
#include "libdsc/page/page.h"
#include "libdsc/surface/digital_surface.h"
#include "libdsc/surface/extract.h"
#include "libdsc/voxels/binary_volume.h"
#include "tests/io/temporary_folder.h"
#include "tests/page/browser.h"
#include "tests/support/spheres.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace dsc {
namespace {

using nlohmann::json;

/// Functions that the steps call.
constexpr const char* kHelp = R"js(
window.set = (id, value) => {
  const control = document.getElementById(id);
  if (control.type === 'checkbox') control.checked = value;
  else if (control.options) {
    control.value = [...control.options].find((o) => o.text === value || o.value === value).value;
  } else control.value = value;
  control.dispatchEvent(new Event('input', {bubbles: true}));
};
window.background = () => getComputedStyle(document.body).backgroundColor.match(/\d+/g).map(Number);
window.isBackground = (x, y) => page.view.seen(x, y).join() === background().join();
window.ticks = () => (page.view.draw(), [...document.querySelectorAll('.scale span')].map((e) => e.textContent));
window.drawnImage = () => {
  page.view.draw();
  const gl = page.view.renderer.getContext();
  const bytes = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight);
  gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
  return bytes;
};
// What is wrong with the captions, surface and panel of this window.
window.clutter = () => {
  const faults = [];
  page.view.draw();
  const boxes = [...document.querySelectorAll('figure')].map((e) => e.getBoundingClientRect());
  const panel = document.getElementById('panel').getBoundingClientRect();
  const meet = (a, b) => a.width > 0 && b.width > 0 && a.left < b.right - 0.5 &&
      b.left < a.right - 0.5 && a.top < b.bottom - 0.5 && b.top < a.bottom - 0.5;
  boxes.forEach((box, i) => {
    if (box.left < 0 || box.top < 0 || box.right > innerWidth || box.bottom > innerHeight + 0.5) {
      faults.push(`caption ${i} leaves the window`);
    }
    if (meet(box, panel)) faults.push(`caption ${i} is under the panel`);
    for (let j = 0; j < i; ++j) if (meet(box, boxes[j])) faults.push('captions meet');
    for (const x of [0.05, 0.5, 0.95]) {
      for (const y of [0.1, 0.5, 0.9]) {
        if (!isBackground(box.left + x * box.width, box.top + y * box.height)) {
          faults.push(`the surface is behind caption ${i}`);
        }
      }
    }
  });
  page.view.rectangles().forEach((r, i) => {
    if (r.width < 100 || r.height < 100) faults.push(`pane ${i} is ${r.width} x ${r.height}`);
    for (const [x, y] of [[2, 2], [r.width / 2, r.height / 2], [r.width - 3, r.height - 3]]) {
      if (isBackground(r.x + x, r.y + y)) faults.push(`pane ${i} is not full`);
    }
  });
  const marks = [...document.querySelectorAll('.scale')].map(
      (scale) => [...scale.children].map((mark) => mark.getBoundingClientRect()));
  for (const scale of marks) {
    for (let i = 1; i < scale.length; ++i) if (meet(scale[i - 1], scale[i])) faults.push('ticks meet');
  }
  return faults;
})js";

json value(const std::string& expression) { return {{"value", expression}}; }
json key(const std::string& name) { return {{"key", name}}; }
json size(int width, int height, bool mobile = false) {
  return {{"size", {width, height, mobile}}};
}

/// Fields of every kind on voxels of the unit sphere.
class UsedPage : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!test::can_drive()) GTEST_SKIP() << test::kNoDriver;
  }
  /// `fields` are made of the mesh.
  template <typename Fields>
  void write(double h, const Fields& fields) {
    surface = testing::sphere(h);
    const FlatMesh mesh = surface.flat();
    write_page(folder / "used.html", {mesh, fields(mesh)});
  }
  void write_two(double h) {
    write(h, [&](const FlatMesh& mesh) {
      for (Index v = 0; v < mesh.vertices(); ++v) {
        up.push_back(mesh.positions[v].dot(Vec3(1., 2., 3.)));
        naive.push_back(1.1 * up.back());
      }
      return std::vector{scalar_field("up", FieldOn::vertex, up),
                         scalar_field("up_naive", FieldOn::vertex, naive)};
    });
  }
  /// Opens the page, then takes the steps; there may be no error in any of them.
  json drive(std::vector<json> steps, const std::string& wishes = "") {
    std::vector<json> all{{{"before", kCount}},
                          {{"open", "file://" + (folder / "used.html") + "#selftest&" + wishes}},
                          {{"wait", "window.page"}},
                          {{"wait", std::string("(() => {") + kHelp + "; return true; })()"}}};
    all.insert(all.end(), steps.begin(), steps.end());
    const json out = test::drive(all);
    EXPECT_EQ(out["errors"], json::array());
    return out["results"];
  }

  /// Counts the triangles that are drawn.
  static constexpr const char* kCount =
      "window.drawn = []; for (const type of [WebGLRenderingContext, WebGL2RenderingContext]) {"
      "  const draw = type.prototype.drawElements;"
      "  type.prototype.drawElements = function(mode, n, ...rest) {"
      "    if (n > 6) window.drawn.push(n / 3);"
      "    return draw.call(this, mode, n, ...rest);"
      "  };"
      "}";
  const TemporaryFolder folder;
  DigitalSurface surface;
  std::vector<double> up, naive;
};

/// A cube fills the box that pages scale surfaces into, and its corners come closer than its faces.
TEST_F(UsedPage, TheFirstViewShowsAllOfACube) {
  const Index n = 12;
  BinaryVolume voxels({{n, n, n}, {1, 1, 1}, Vec3::Zero()});
  for (Index z = 0; z < n; ++z) {
    for (Index y = 0; y < n; ++y) {
      for (Index x = 0; x < n; ++x) voxels.set(x, y, z, true);
    }
  }
  surface = extract_surface(voxels);
  const FlatMesh mesh = surface.flat();
  for (Index v = 0; v < mesh.vertices(); ++v) up.push_back(mesh.positions[v][2]);
  write_page(folder / "used.html", {mesh, {scalar_field("up", FieldOn::vertex, up)}});
  const std::string farthest =
      "(() => { const {view, model} = page; const r = view.rectangles()[0];"
      " const camera = view.orbit.cameraFor(r.width, r.height); let most = 0;"
      " for (let i = 0; i < model.points.length; i += 3) {"
      "   const p = new THREE.Vector3(...model.points.subarray(i, i + 3)).project(camera);"
      "   most = Math.max(most, Math.abs(p.x), Math.abs(p.y));"
      " } return most; })()";
  const json seen = drive({size(1300, 800), value(farthest), size(420, 800, true), value(farthest),
                           size(1600, 400), value(farthest)});
  for (const json& most : seen) {
    EXPECT_LT(most.get<double>(), 1.);
    EXPECT_GT(most.get<double>(), 0.5);
  }
}

TEST_F(UsedPage, CaptionsKeepClearOfTheSurfaceInAnyWindow) {
  write_two(0.1);
  std::vector<json> steps{value("page.view.orbit.zoom(0.1)")};
  for (const char* beside : {"up_naive", "nothing"}) {
    for (const char* theme : {"light", "dark"}) {
      for (const json& window :
           {size(1600, 1000), size(1024, 700), size(420, 800, true), size(800, 420, true)}) {
        steps.push_back(
            value(std::string("set('beside', '") + beside + "'), set('theme', '" + theme + "')"));
        steps.push_back(window);
        steps.push_back(value("clutter()"));
        steps.push_back(value("document.getElementById('fold').click()"));
        steps.push_back(value("clutter()"));
        steps.push_back(value("document.getElementById('fold').click()"));
      }
    }
  }
  for (const json& result : drive(steps)) {
    if (result.is_array()) {
      EXPECT_EQ(result, json::array());
    }
  }
}

TEST_F(UsedPage, APictureIsOnePassageOverTheSurfaceEvenOfTwoPanes) {
  write_two(0.0077);
  ASSERT_GT(surface.face_count(), 300000);  // smaller ones have smooth edges, two passages each
  // Not the self-test, which draws more pictures.
  const json out =
      test::drive({{{"before", kCount}},
                   {{"open", "file://" + (folder / "used.html")}},
                   {{"wait", "document.getElementById('message').hidden && drawn.length"}},
                   {{"pause", 500}},
                   value("drawn"),
                   key("Tab"),
                   key("ArrowLeft"),
                   {{"pause", 500}},
                   value("drawn")});
  EXPECT_EQ(out["errors"], json::array());
  const auto triangles = 2 * surface.face_count();
  EXPECT_EQ(out["results"][0], json({triangles}));
  EXPECT_EQ(out["results"][1], json({triangles, triangles}));

  // One passage draws what two do.
  const json same = drive({value("set('isolines', 30), set('clip', 'x'), page.view.pairs"),
                           value("window.one = drawnImage(), page.view.pairs = false,"
                                 "window.two = drawnImage(), one.length"),
                           value("one.filter((byte, i) => Math.abs(byte - two[i]) > 1).length"),
                           value("new Set(one).size")},
                          "theme=dark");
  EXPECT_EQ(same[0], true);
  EXPECT_GT(same[1], 1000000);
  // Derivatives are differences within blocks of 2 x 2 pixels, which lie elsewhere in an image of
  // its own: single pixels of lines and shades differ.
  EXPECT_LT(same[2], same[1].get<int>() / 10000);
  EXPECT_GT(same[3], 100) << "there is something in it";
}

TEST_F(UsedPage, WithoutWebGlOrScriptsASentenceStandsInItsPlace) {
  write_two(0.2);
  const char* seen = "document.elementFromPoint(innerWidth / 2, innerHeight / 2).innerText";
  const std::string at = "file://" + (folder / "used.html");
  for (const char* flags : {"--disable-3d-apis", "--disable-gpu --disable-software-rasterizer"}) {
    const json out = test::drive(
        {{{"open", at}}, {{"wait", std::string(seen) + ".includes('WebGL')"}}, value(seen)}, flags);
    EXPECT_NE(out["results"][0].get<std::string>().find("cannot draw"), std::string::npos);
    EXPECT_EQ(out["errors"], json::array());
  }
  const json out = test::drive({{{"scripts", false}},
                                {{"open", at}},
                                {{"wait", "document.querySelector('.noscript')"}},
                                value("document.body.innerText.trim()")});
  const auto text = out["results"][0].get<std::string>();
  EXPECT_NE(text.find("switched off"), std::string::npos) << text;
  EXPECT_EQ(text.find("Unpacking"), std::string::npos) << text;
  EXPECT_EQ(text.find("Field"), std::string::npos) << text;
}

TEST_F(UsedPage, ColoursAreLightOrDarkWithoutNewCss) {
  write_two(0.2);
  EXPECT_EQ(read_all(folder / "used.html").find(": light-dark("), std::string::npos)
      << "browsers before 2024 would have no colours";
  std::vector<json> steps;
  for (const char* scheme : {"light", "dark"}) {
    steps.push_back({{"scheme", scheme}});
    for (const char* theme : {"as the system", "light", "dark"}) {
      steps.push_back(value(std::string("set('theme', '") + theme + "')"));
      steps.push_back(value("page.view.pixel(1, 1)"));
    }
  }
  const json light{0xf4, 0xf3, 0xf0}, dark{0x17, 0x18, 0x1a};
  const json r = drive(steps);
  const std::vector<json> expected{light, light, dark, dark, light, dark};
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(r[2 * i + 1], expected[i]) << i;
}

TEST_F(UsedPage, KeysReachAndDoEverything) {
  write_two(0.2);
  const char* eye = "page.view.orbit.cameraFor(1, 1).position.toArray().map((x) => +x.toFixed(6))";
  const char* focus = "document.activeElement.id";
  std::vector<json> steps{value("page.panel.show(null)"), key("Tab"), value(focus), value(eye)};
  for (const char* name : {"ArrowLeft", "ArrowUp", "+", "ArrowRight", "ArrowDown", "-"}) {
    steps.push_back(key(name));
    steps.push_back(value(eye));
  }
  steps.insert(steps.end(), {key("0"), value(eye), key("Enter"),
                             value("document.getElementById('reading').rows.length"), key("Escape"),
                             value("document.getElementById('reading').rows.length"), key("Tab"),
                             value(focus), key("Space"), value("document.body.className"),
                             key("Space"), value("document.body.className")});
  const char* ids[] = {"field",  "beside",   "share",   "map",  "low",   "high",   "all",
                       "middle", "isolines", "shading", "clip", "theme", "vertex", "home"};
  for ([[maybe_unused]] const char* id : ids) {
    steps.insert(steps.end(), {key("Tab"), value(focus)});
  }
  const json r = drive(steps);
  EXPECT_EQ(r[1], "canvas");
  for (std::size_t i = 3; i <= 8; ++i) EXPECT_NE(r[i], r[i - 1]) << i;
  EXPECT_EQ(r[9], r[2]) << "0 is the first view";
  EXPECT_GT(r[10], 4);
  EXPECT_EQ(r[11], 0);
  EXPECT_EQ(r[12], "fold");
  EXPECT_EQ(r[13], "folded");
  EXPECT_EQ(r[14], "");
  for (std::size_t i = 0; i < std::size(ids); ++i) EXPECT_EQ(r[15 + i], ids[i]);
}

TEST_F(UsedPage, OneFingerTurnsTwoPinchATapReads) {
  write_two(0.2);
  const char* rows = "document.getElementById('reading').rows.length";
  const json r = drive({size(420, 800, true),
                        value("page.panel.show(null), page.view.orbit.distance"),
                        value("page.view.orbit.rotation.toArray()"),
                        {{"touch", {{{100, 150}, {140, 150}}, {{60, 150}, {140, 150}}}}},
                        value("page.view.orbit.distance"),
                        value("page.view.orbit.rotation.toArray()"),
                        value(rows),
                        {{"touch", {{{100, 150}}, {{160, 150}}}}},
                        value("page.view.orbit.rotation.toArray()"),
                        value(rows),
                        value("page.view.orbit.reset()"),
                        value("page.view.rectangles()[0].y + page.view.rectangles()[0].height / 2"),
                        {{"touch", {{{105, 165}}}}},
                        value(rows)});
  EXPECT_NEAR(r[2].get<double>(), 0.5 * r[0].get<double>(), 1e-6);
  EXPECT_EQ(r[3], r[1]) << "a pinch does not turn";
  EXPECT_EQ(r[4], 0) << "nor does it read, though one finger kept still";
  EXPECT_NE(r[5], r[3]);
  EXPECT_EQ(r[6], 0);
  EXPECT_GT(r[9], 4);
}

TEST_F(UsedPage, RangesTypedInAnyWayAreDrawn) {
  write_two(0.1);
  const char* middle = "page.view.pixel(450, 310)";
  const json r = drive(
      {value("set('beside', 'nothing'), set('isolines', 0), set('shading', 'none')"),
       value("set('low', -2), set('high', 3)"), value(middle), value("ticks()"),
       value("set('low', 3), set('high', -2)"), value(middle), value("ticks()"),
       // Beyond all values, by one end and by both.
       value("set('low', 50), set('high', '')"), value("ticks()"),
       value("document.querySelector('.bar').className"), value("set('low', ''), set('high', -50)"),
       value("ticks()"), value("document.querySelector('.bar').className"),
       value("set('low', 1), set('high', 1)"), value("ticks()")});
  EXPECT_EQ(r[5], r[2]) << "backwards is forwards";
  EXPECT_EQ(r[6], r[3]);
  EXPECT_EQ(r[8][0], "50");
  EXPECT_GT(r[8].size(), 2U);
  EXPECT_EQ(r[9], "bar below");
  EXPECT_EQ(r[11].back(), "−50");
  EXPECT_EQ(r[12], "bar above");
  EXPECT_GE(r[14].size(), 2U);
}

TEST_F(UsedPage, FieldsOfEveryKindAreShownAndTheirNumbersDiffer) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  std::vector<double> nowhere, constant, far, partial, swirl, label;
  write(0.1, [&](const FlatMesh& mesh) {
    for (Index v = 0; v < mesh.vertices(); ++v) {
      const Vec3 p = mesh.positions[v];
      nowhere.push_back(kInf);
      constant.push_back(3.);
      far.push_back(123456. + 0.01 * p[2]);
      partial.push_back(p[0] > 0 ? p[0] : kInf);
    }
    for (Index f = 0; f < mesh.faces(); ++f) {
      const Vec3 n = mesh.normals[f];
      for (int axis = 0; axis < 3; ++axis) swirl.push_back(n[axis]);
      label.push_back(std::floor(20. * n[2]));
    }
    return std::vector{scalar_field("far", FieldOn::vertex, far),
                       scalar_field("nowhere", FieldOn::vertex, nowhere),
                       scalar_field("constant", FieldOn::vertex, constant),
                       scalar_field("partial", FieldOn::vertex, partial),
                       vector_field("swirl", {"sx", "sy", "sz"}, FieldOn::face,
                                    {swirl.data(), static_cast<Index>(swirl.size() / 3)}),
                       scalar_field("label", FieldOn::face, label)};
  });
  std::vector<json> steps{
      value("set('field', 'nowhere'), document.querySelector('figure').textContent"),
      value("set('field', 'constant'), document.getElementById('lines').textContent"),
      value("set('field', 'partial'), document.querySelector('figure p').textContent"),
      value("set('field', 'label'), document.querySelectorAll('.labels span').length"),
      value("set('field', 'far'), document.getElementById('middle').click(), [+low.value, "
            "+high.value]"),
      value("page.view.draw(), ticks()")};
  for (const char* name :
       {"|swirl|", "sx", "far", "nowhere", "constant", "partial", "label", "none"}) {
    for (const char* beside : {"nothing", "sy", "label", "nowhere"}) {
      steps.push_back(
          value(std::string("set('field', '") + name + "'), set('beside', '" + beside +
                "'), page.view.pixel(1, 1), page.view.renderer.getContext().getError()"));
    }
  }
  const json r = drive(steps);
  EXPECT_EQ(r[0], "nowheregrey: infinite everywhere");
  EXPECT_EQ(r[1], "none");
  EXPECT_EQ(r[2], "grey: infinite");
  EXPECT_EQ(r[3], 24);
  EXPECT_LT(r[4][0], r[4][1]) << "98 % of values that differ in the seventh digit";
  const auto ticks = r[5].get<std::vector<std::string>>();
  EXPECT_GE(ticks.size(), 2U);
  for (std::size_t i = 1; i < ticks.size(); ++i) EXPECT_NE(ticks[i], ticks[i - 1]);
  for (std::size_t i = 6; i < r.size(); ++i) EXPECT_EQ(r[i], 0);
}

}  // namespace
}  // namespace dsc
