#include "libdsc/surface/digital_surface.h"

#include "libdsc/base/error.h"

namespace dsc {
namespace {

using NormalHandle = OpenMesh::FPropHandleT<OpenMesh::Vec3d>;

}  // namespace

DigitalSurface::DigitalSurface() : mesh_(std::make_unique<SurfaceMesh>()) {
  mesh_->add_property(corners_, property::kCorners);
  mesh_->add_property(surfels_, property::kSurfel);
}

DigitalSurface::DigitalSurface(const DigitalSurface& other) { *this = other; }

DigitalSurface& DigitalSurface::operator=(const DigitalSurface& other) {
  if (this != &other) {
    mesh_ = std::make_unique<SurfaceMesh>(*other.mesh_);
    corners_ = other.corners_;  // handles are positions in the mesh's list of properties
    surfels_ = other.surfels_;
    labels_ = other.labels_;
    grid_ = other.grid_;
    adjacency_ = other.adjacency_;
    glue_ = other.glue_;
    vertex_count_ = other.vertex_count_;
    counts_ = other.counts_;
  }
  return *this;
}

std::span<const QuadCorners> DigitalSurface::corners() const {
  if (mesh_->n_faces() == 0) return {};
  return {&mesh_->property(corners_, OpenMesh::FaceHandle(0)), mesh_->n_faces()};
}

std::span<const Surfel> DigitalSurface::surfels() const {
  if (mesh_->n_faces() == 0) return {};
  return {&mesh_->property(surfels_, OpenMesh::FaceHandle(0)), mesh_->n_faces()};
}

std::span<const LabelPair> DigitalSurface::labels() const {
  if (mesh_->n_faces() == 0 || !labels_.is_valid()) return {};
  return {&mesh_->property(labels_, OpenMesh::FaceHandle(0)), mesh_->n_faces()};
}

Vec3View DigitalSurface::normals() const {
  NormalHandle handle;
  if (mesh_->n_faces() == 0 || !mesh_->get_property_handle(handle, property::kNormal)) return {};
  return {mesh_->property(handle, OpenMesh::FaceHandle(0)).data(), face_count()};
}

void DigitalSurface::set_normals(const Eigen::Ref<const Eigen::Matrix3Xd>& u) {
  if (u.cols() != face_count()) {
    throw UsageError("set_normals: " + std::to_string(u.cols()) + " normals for " +
                     std::to_string(face_count()) + " faces");
  }
  NormalHandle handle;
  if (!mesh_->get_property_handle(handle, property::kNormal)) {
    mesh_->add_property(handle, property::kNormal);
  }
  for (Index f = 0; f < face_count(); ++f) {
    mesh_->property(handle, OpenMesh::FaceHandle(static_cast<int>(f))) = {u(0, f), u(1, f),
                                                                          u(2, f)};
  }
}

void DigitalSurface::remove_normals() {
  NormalHandle handle;
  if (mesh_->get_property_handle(handle, property::kNormal)) mesh_->remove_property(handle);
}

FlatMesh DigitalSurface::flat(bool with_normals) const {
  FlatMesh flat;
  flat.positions = positions();
  const auto quads = corners();
  flat.corners = {quads.empty() ? nullptr : quads.front().data(), 4 * quads.size()};
  if (with_normals) flat.normals = normals();
  flat.surfels = surfels();
  flat.spacing = grid_.spacing;
  return flat;
}

}  // namespace dsc
