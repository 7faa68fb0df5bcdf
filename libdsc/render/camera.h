/// \file
/// From where a surface is looked at: an orthographic camera, so that lengths across the view can
/// be measured in the picture.
#pragma once

#include "libdsc/surface/flat_mesh.h"

#include <string>

namespace dsc::render {

/// A direction of view, in degrees, and which way is up.
///
/// With z up, azimuth 0 looks from -y ("front", of a patient in LPS the face), 90 from +x
/// ("right"); elevation 90 from above. `up` may be any axis; the frame turns with it.
struct View {
  double azimuth = 30;    ///< around the axis that is up
  double elevation = 20;  ///< -90 to 90
  std::string up = "z";   ///< x, y, z, -x, -y or -z

  /// Of a name (front, back, left, right, top, bottom, iso) or of "AZIMUTH,ELEVATION".
  /// \throws UsageError that says what is expected.
  static View of(const std::string& text, const std::string& up = "z");

  /// The directions in the picture, in the world: to the right, up, and towards the viewer; a
  /// right-handed orthonormal frame, one a column. \throws UsageError where `up` is no axis.
  Mat3 frame() const;
};

/// A rectangle of the picture, in pixels from its top left corner.
struct Rectangle {
  double left = 0;    ///< of its left side
  double top = 0;     ///< of its upper side
  double width = 0;   ///< from left to right
  double height = 0;  ///< from top to bottom
};

/// Maps the world to pixels: x from the left, y from the top, z towards the viewer, all to one
/// scale.
class Camera {
 public:
  /// Leaves everything as it is.
  Camera() = default;
  /// The vertices as large as `area` allows, in its middle.
  Camera(const View& view, const FlatMesh& mesh, const Rectangle& area);

  /// Where a point of the world lies.
  Vec3 operator()(const Vec3& p) const { return scale_ * (turn_ * (p - centre_)) + middle_; }
  /// A direction, in units of the world and the axes of the picture (y down).
  Vec3 turned(const Vec3& v) const { return turn_ * v; }
  /// Pixels to a unit of the world.
  double scale() const { return scale_; }

 private:
  Mat3 turn_ = Mat3::Identity();
  Vec3 centre_ = Vec3::Zero(), middle_ = Vec3::Zero();
  double scale_ = 1;
};

}  // namespace dsc::render
