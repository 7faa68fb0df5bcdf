#include "libdsc/render/camera.h"

#include "libdsc/base/error.h"

#include <Eigen/Geometry>

#include <charconv>
#include <cmath>
#include <numbers>

namespace dsc::render {
namespace {

struct Named {
  const char* name;
  double azimuth, elevation;
};
// iso: the three axes are seen equally short.
const Named kViews[] = {{"front", 0, 0},
                        {"back", 180, 0},
                        {"left", -90, 0},
                        {"right", 90, 0},
                        {"top", 0, 90},
                        {"bottom", 0, -90},
                        {"iso", 45, 180 / std::numbers::pi* std::atan(std::sqrt(0.5))}};

bool read_number(const std::string& text, double& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() && std::isfinite(number);
}

/// What the view from the front shows to the right, away from the viewer and upwards: a
/// right-handed frame, one a column.
Mat3 front(const std::string& up) {
  const bool negative = up.size() == 2 && up[0] == '-';
  const char axis = up.empty() ? ' ' : up.back();
  if (up.size() > (negative ? 2U : 1U) || axis < 'x' || axis > 'z') {
    throw UsageError("'" + up + "' is no way up: expected x, y, z, -x, -y or -z");
  }
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  Mat3 frame;
  if (axis == 'x') frame << y, z, x;
  if (axis == 'y') frame << x, -z, y;
  if (axis == 'z') frame << x, y, z;
  if (negative) frame.rightCols<2>() *= -1.;
  return frame;
}

double cosine(double degrees) { return std::cos(degrees * std::numbers::pi / 180); }
double sine(double degrees) { return std::sin(degrees * std::numbers::pi / 180); }

}  // namespace

View View::of(const std::string& text, const std::string& up) {
  View view;
  view.up = up;
  front(up);  // checked
  for (const Named& named : kViews) {
    if (text != named.name) continue;
    view.azimuth = named.azimuth;
    view.elevation = named.elevation;
    return view;
  }
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos || !read_number(text.substr(0, comma), view.azimuth) ||
      !read_number(text.substr(comma + 1), view.elevation) || std::abs(view.elevation) > 90 ||
      std::abs(view.azimuth) > 360) {
    throw UsageError("'" + text +
                     "' is no view: expected front, back, left, right, top, bottom, iso or "
                     "AZIMUTH,ELEVATION in degrees, the azimuth from -360 to 360, the elevation "
                     "from -90 to 90");
  }
  return view;
}

Mat3 View::frame() const {
  const double ca = cosine(azimuth), sa = sine(azimuth), ce = cosine(elevation),
               se = sine(elevation);
  Mat3 turned;
  turned << Vec3(ca, sa, 0), Vec3(-sa * se, ca * se, ce), Vec3(sa * ce, -ca * ce, se);
  return front(up) * turned;
}

Camera::Camera(const View& view, const FlatMesh& mesh, const Rectangle& area) {
  turn_ = view.frame().transpose();
  turn_.row(1) *= -1.;  // rows of pixels run downwards
  // Vertices of no face are not seen, and do not count.
  Eigen::AlignedBox3d box;
  for (const VertexId v : mesh.corners) box.extend(Vec3(turn_ * mesh.positions[v]));
  centre_ = turn_.transpose() * box.center();
  const Vec3 size = box.sizes();
  scale_ = std::min(size[0] > 0 ? area.width / size[0] : INFINITY,
                    size[1] > 0 ? area.height / size[1] : INFINITY);
  if (!std::isfinite(scale_)) scale_ = 1;
  middle_ = {area.left + area.width / 2, area.top + area.height / 2, 0.};
}

}  // namespace dsc::render
