#include "tests/support/vdb_files.h"

#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <fstream>

namespace dsc::test {
namespace {

openvdb::Coord coord(const std::array<std::int32_t, 3>& at) { return {at[0], at[1], at[2]}; }

template <class Grid>
openvdb::GridBase::Ptr filled(const VdbGrid& spec) {
  using Value = typename Grid::ValueType;
  const auto grid = Grid::create(static_cast<Value>(spec.background));
  for (const VdbFill& fill : spec.fills) {
    grid->fill(openvdb::CoordBBox(coord(fill.first), coord(fill.last)),
               static_cast<Value>(fill.value), fill.active);
  }
  auto accessor = grid->getAccessor();
  for (const VdbVoxel& voxel : spec.voxels) {
    accessor.setValueOn(coord(voxel.at), static_cast<Value>(voxel.value));
  }
  if (spec.dense) grid->tree().voxelizeActiveTiles();
  return grid;
}

openvdb::GridBase::Ptr filled_vectors(const VdbGrid& spec) {
  const auto grid = openvdb::Vec3SGrid::create();
  for (const VdbVoxel& voxel : spec.voxels) {
    grid->tree().setValueOn(coord(voxel.at), openvdb::Vec3s(static_cast<float>(voxel.value)));
  }
  return grid;
}

openvdb::GridBase::Ptr voxels_of(const VdbGrid& spec) {
  switch (spec.type) {
    case VdbType::float32:
    case VdbType::half:
      return filled<openvdb::FloatGrid>(spec);
    case VdbType::float64:
      return filled<openvdb::DoubleGrid>(spec);
    case VdbType::int32:
      return filled<openvdb::Int32Grid>(spec);
    case VdbType::int64:
      return filled<openvdb::Int64Grid>(spec);
    case VdbType::boolean:
      return filled<openvdb::BoolGrid>(spec);
    case VdbType::mask:
      return filled<openvdb::MaskGrid>(spec);
    case VdbType::vector:
      return filled_vectors(spec);
  }
  return nullptr;
}

openvdb::math::Transform::Ptr transform_of(const Eigen::Matrix4d& matrix) {
  openvdb::Mat4d rows;  // whose rows are our columns
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) rows(j, i) = matrix(i, j);
  }
  return openvdb::math::Transform::createLinearTransform(rows);
}

openvdb::GridBase::Ptr make_grid(const VdbGrid& spec) {
  const openvdb::GridBase::Ptr grid = voxels_of(spec);
  grid->setName(spec.name);
  grid->setSaveFloatAsHalf(spec.type == VdbType::half);
  if (spec.grid_class == VdbClass::level_set) grid->setGridClass(openvdb::GRID_LEVEL_SET);
  if (spec.grid_class == VdbClass::fog_volume) grid->setGridClass(openvdb::GRID_FOG_VOLUME);
  grid->setTransform(spec.frustum ? openvdb::math::Transform::createFrustumTransform(
                                        openvdb::BBoxd({0, 0, 0}, {10, 10, 10}), 0.5, 10, 1)
                                  : transform_of(spec.matrix));
  return grid;
}

}  // namespace

void write_vdb(const std::string& path, const std::vector<VdbGrid>& grids, VdbForm form) {
  openvdb::initialize();
  openvdb::GridPtrVec made;
  for (const VdbGrid& spec : grids) made.push_back(make_grid(spec));
  if (form == VdbForm::stream) {
    std::ofstream file(path, std::ios::binary);
    openvdb::io::Stream(file).write(made);
    return;
  }
  openvdb::io::File file(path);
  file.setCompression(form == VdbForm::plain ? openvdb::io::COMPRESS_NONE
                      : form == VdbForm::zip
                          ? openvdb::io::COMPRESS_ZIP | openvdb::io::COMPRESS_ACTIVE_MASK
                          : openvdb::io::COMPRESS_BLOSC | openvdb::io::COMPRESS_ACTIVE_MASK);
  file.write(made);
}

void write_vdb_ball(const std::string& path, const std::string& name, double radius,
                    const Vec3& centre, const Eigen::Matrix4d& matrix) {
  openvdb::initialize();
  const auto grid = openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(
      static_cast<float>(radius), openvdb::Vec3f(openvdb::Vec3d(centre[0], centre[1], centre[2])),
      1.F);
  grid->setName(name);
  grid->setTransform(transform_of(matrix));
  openvdb::io::File(path).write({grid});
}

void write_vdb_instances(const std::string& path) {
  openvdb::initialize();
  const auto one = make_grid({.name = "one", .voxels = {{{1, 2, 3}, 4}, {{2, 2, 3}, 5}}});
  const auto two = one->copyGrid();  // the tree is shared
  two->setName("two");
  two->setTransform(one->transform().copy());
  two->transform().postTranslate({10, 0, 0});
  openvdb::io::File(path).write({one, two});
}

}  // namespace dsc::test
