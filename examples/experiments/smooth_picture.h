/// \file
/// Fields of a digital surface projected back onto the smooth one, for pictures as in the paper;
/// nothing where dsc::truth is not built.
#pragma once

#include "libdsc/voxels/closest_point.h"
#include "study.h"

#ifdef STUDY_WITH_TRUTH
#include "libdsc/truth/field_transfer.h"
#include "libdsc/truth/smooth_mesh.h"
#endif

#include <utility>
#include <vector>

namespace study {

using VertexFields = std::vector<std::pair<std::string, Eigen::VectorXd>>;

/// Writes the fields on the surfels as FOLDER/NAME, and on a mesh of the shape of edges of a
/// gridstep, or the part of it where `part` is true, as FOLDER/NAME_smooth; see write().
template <class Part>
void write_picture(const Arguments& arguments, const std::string& name,
                   const dsc::ImplicitShape& shape, const dsc::DigitalSurface& surface,
                   const VertexFields& fields, const dsc::render::PictureOptions& options,
                   Part&& part) {
  dsc::Result digital{surface.flat(), {}};
  for (const auto& [field, values] : fields) {
    digital.fields.push_back(dsc::scalar_field(field, dsc::FieldOn::vertex, values));
  }
  write(arguments, name, digital, options);
#ifdef STUDY_WITH_TRUTH
  const dsc::truth::TriangleMesh whole =
      dsc::truth::smooth_mesh(shape, {.edge_length = surface.grid().spacing.maxCoeff()}).mesh;
  dsc::truth::TriangleMesh smooth{whole.vertices, {}};
  for (const dsc::truth::Triangle& face : whole.faces) {
    bool all = true;
    for (const dsc::VertexId v : face) all = all && part(dsc::Vec3(whole.vertices.col(v)));
    if (all) smooth.faces.push_back(face);
  }
  const Eigen::Matrix3Xd corners = dsc::project_points(shape, surface.positions()).points;
  const dsc::truth::FieldTransfer transfer = dsc::truth::field_transfer(
      surface.flat(), {corners.data(), corners.cols()}, smooth.positions());
  VertexFields back;
  for (const auto& [field, values] : fields) {
    back.emplace_back(field, transfer.vertex_weights * values);
  }
  const dsc::GatheredMesh mesh = dsc::truth::gathered(smooth);
  dsc::Result result{mesh.view(), {}};
  for (const auto& [field, values] : back) {
    result.fields.push_back(dsc::scalar_field(field, dsc::FieldOn::vertex, values));
  }
  write(arguments, name + "_smooth", result, options);
#else
  static_cast<void>(shape);
  static_cast<void>(part);
#endif
}

inline void write_picture(const Arguments& arguments, const std::string& name,
                          const dsc::ImplicitShape& shape, const dsc::DigitalSurface& surface,
                          const VertexFields& fields, const dsc::render::PictureOptions& options) {
  write_picture(arguments, name, shape, surface, fields, options,
                [](const dsc::Vec3&) { return true; });
}

}  // namespace study
