#include "libdsc/render/tracer.h"

#include "libdsc/base/error.h"
#include "libdsc/base/parallel.h"
#include "libdsc/render/camera.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace dsc::render {
namespace {

/// The best hit of a ray so far, by depth and then by number.
struct Query {
  RTCIntersectContext context;  // first: Embree hands it back as a pointer
  unsigned primitive;
  float distance, u, v;
};

/// Sees every candidate that is not farther than the nearest so far, equal ones too.
void keep_best(const RTCFilterFunctionNArguments* arguments) {
  auto* query = reinterpret_cast<Query*>(arguments->context);
  const auto* ray = reinterpret_cast<const RTCRay*>(arguments->ray);
  const auto* hit = reinterpret_cast<const RTCHit*>(arguments->hit);
  if (ray->tfar > query->distance ||
      (ray->tfar == query->distance && hit->primID > query->primitive)) {
    return;
  }
  *query = {query->context, hit->primID, ray->tfar, hit->u, hit->v};
}

bool go_on(void* context, double /*part*/) {
  const auto* monitor = static_cast<const Context*>(context)->monitor;
  return monitor == nullptr || !monitor->cancelled();
}

}  // namespace

struct Tracer::Embree {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  ~Embree() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }
  void check(const Context& context) const {
    const RTCError error = rtcGetDeviceError(device);
    if (error == RTC_ERROR_NONE) return;
    context.check();
    if (error == RTC_ERROR_OUT_OF_MEMORY) {
      throw LimitError("there is no memory to draw this surface; draw a part of it");
    }
    throw Error("Embree fails with error " + std::to_string(static_cast<int>(error)));
  }
};

Tracer::Tracer(const FlatMesh& mesh, const Camera& camera, const Context& context)
    : mesh_(mesh), embree_(std::make_unique<Embree>()) {
  positions_.resize(static_cast<std::size_t>(3 * mesh.vertices() + 1));
  parallel_for(context, mesh.vertices(), 1 << 14, [&](Index first, Index last) {
    for (Index v = first; v < last; ++v) {
      const Vec3 p = camera(mesh.positions[v]);
      for (Index i = 0; i < 3; ++i) {
        positions_[static_cast<std::size_t>(3 * v + i)] = static_cast<float>(p[i]);
      }
    }
  });
  nearest_ = -std::numeric_limits<float>::infinity();
  for (const VertexId v : mesh.corners) {
    nearest_ = std::max(nearest_, positions_[static_cast<std::size_t>(3 * v + 2)]);
  }
  nearest_ += 1 + 1e-3F * std::abs(nearest_);

  bool quads = true;
  for (Index f = 0; f < mesh.faces() && quads; ++f) quads = mesh.face(f).size() == 4;
  if (quads) {
    corners_.assign(mesh.corners.begin(), mesh.corners.end());
  } else {
    for (Index f = 0; f < mesh.faces(); ++f) {
      const auto face = mesh.face(f);
      for (std::size_t k = 1; k + 1 < face.size(); ++k) {
        for (const VertexId v : {face[0], face[k], face[k + 1]}) {
          corners_.push_back(static_cast<std::uint32_t>(v));
        }
        fan_faces_.push_back(static_cast<std::uint32_t>(f));
        fan_slots_.push_back(static_cast<std::uint32_t>(k));
      }
    }
  }

  // Not "threads=N": that would hold for every loop of the process while the device lives.
  embree_->device = rtcNewDevice(nullptr);
  if (embree_->device == nullptr) throw Error("Embree does not run on this machine");
  embree_->scene = rtcNewScene(embree_->device);
  // Robust: a ray meets whatever it touches, however the faces were sorted into boxes.
  rtcSetSceneFlags(embree_->scene,
                   static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_COMPACT));
  const RTCGeometry geometry =
      rtcNewGeometry(embree_->device, quads ? RTC_GEOMETRY_TYPE_QUAD : RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                             positions_.data(), 0, 3 * sizeof(float),
                             static_cast<std::size_t>(mesh.vertices()));
  const std::size_t n = quads ? 4 : 3;
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0,
                             quads ? RTC_FORMAT_UINT4 : RTC_FORMAT_UINT3, corners_.data(), 0,
                             n * sizeof(std::uint32_t), corners_.size() / n);
  rtcSetGeometryIntersectFilterFunction(geometry, &keep_best);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(embree_->scene, geometry);
  rtcReleaseGeometry(geometry);
  embree_->check(context);
  rtcSetSceneProgressMonitorFunction(embree_->scene, &go_on, const_cast<Context*>(&context));
  run_within(context, [&] { rtcJoinCommitScene(embree_->scene); });
  rtcSetSceneProgressMonitorFunction(embree_->scene, nullptr, nullptr);
  embree_->check(context);
}

Tracer::~Tracer() = default;

Hit Tracer::operator()(double x, double y) const {
  Query query{};
  rtcInitIntersectContext(&query.context);
  query.primitive = RTC_INVALID_GEOMETRY_ID;
  query.distance = std::numeric_limits<float>::infinity();
  RTCRayHit ray{};
  ray.ray.org_x = static_cast<float>(x);
  ray.ray.org_y = static_cast<float>(y);
  ray.ray.org_z = nearest_;
  ray.ray.dir_z = -1;
  ray.ray.tfar = std::numeric_limits<float>::infinity();
  ray.ray.mask = ~0U;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(embree_->scene, &query.context, &ray);

  Hit hit;
  if (query.primitive == RTC_INVALID_GEOMETRY_ID) return hit;
  hit.depth = static_cast<double>(nearest_) - static_cast<double>(query.distance);
  const double u = query.u, v = query.v;
  if (fan_faces_.empty()) {
    hit.face = query.primitive;
    hit.slot = {0, 1, 2, 3};
    hit.weight = {(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v};
  } else {
    hit.face = fan_faces_[query.primitive];
    const auto k = static_cast<int>(fan_slots_[query.primitive]);
    hit.slot = {0, k, k + 1, -1};
    hit.weight = {1 - u - v, u, v, 0};
  }
  // In the picture y runs down: the sense of a face seen from outside is turned round.
  hit.front = doubled_area(hit) < 0;
  return hit;
}

double Tracer::doubled_area(const Hit& hit) const {
  const auto face = mesh_.face(hit.face);
  const int n = hit.slot[3] < 0 ? 3 : 4;
  double area = 0;
  for (int i = 0; i < n; ++i) {
    const auto corner = [&](int k) {
      return position(face[static_cast<std::size_t>(hit.slot[static_cast<std::size_t>(k % n)])]);
    };
    const Vec3 p = corner(i), q = corner(i + 1);
    area += p[0] * q[1] - p[1] * q[0];
  }
  return area;
}

Vec3 Tracer::position(VertexId v) const {
  const auto i = static_cast<std::size_t>(3 * v);
  return Vec3(positions_[i], positions_[i + 1], positions_[i + 2]);
}

}  // namespace dsc::render
