/// \file
/// \internal
/// What lies behind a point of the picture: the surface in pixel coordinates, traced by Embree.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/surface/flat_mesh.h"

#include <array>
#include <memory>
#include <vector>

namespace dsc::render {

class Camera;

/// The foremost point of a surface.
struct Hit {
  Index face = -1;               ///< -1: nothing is there
  double depth = 0;              ///< larger is nearer
  std::array<int, 4> slot;       ///< which of the face's corners the point lies between; -1: unused
  std::array<double, 4> weight;  ///< of those corners; they sum to 1
  bool front = true;             ///< whether the face's outside is seen

  explicit operator bool() const { return face >= 0; }
};

/// A mesh made ready. Quads are bilinear patches in their values; larger faces, and quads among
/// them, are cut into fans from their first corners. Vertices are floats, in pixels.
///
/// Where several faces lie at the same depth, to the last bit, the one of the lowest number is
/// seen, so that answers never depend on the order in which Embree meets them.
class Tracer {
 public:
  /// \throws LimitError where Embree has no memory; Cancelled.
  Tracer(const FlatMesh& mesh, const Camera& camera, const Context& context);
  ~Tracer();
  Tracer(const Tracer&) = delete;
  Tracer& operator=(const Tracer&) = delete;

  /// At x from the left and y from the top, in pixels. Safe from many threads at once.
  Hit operator()(double x, double y) const;

  /// The position of a vertex in the picture, as it is traced.
  Vec3 position(VertexId v) const;

 private:
  /// Of what is seen of the triangle or quad, in pixels; positive where its corners run clockwise.
  double doubled_area(const Hit& hit) const;

  struct Embree;  // so that no header of Embree's shows here
  FlatMesh mesh_;
  std::vector<float> positions_;          ///< x, y, z; and one more float, which Embree may read
  std::vector<std::uint32_t> corners_;    ///< of the primitives
  std::vector<std::uint32_t> fan_faces_;  ///< of triangles: their face; empty for quads
  std::vector<std::uint32_t> fan_slots_;  ///< of triangles: their second corner in the face
  float nearest_ = 0;                     ///< where rays start
  std::unique_ptr<Embree> embree_;
};

}  // namespace dsc::render
