#include "libdsc/io/vdb/vdb_image.h"

#include "libdsc/io/vdb/vdb_file.h"

#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <ios>
#include <sstream>
#include <type_traits>
#include <utility>
#include <vector>

#include <unistd.h>

namespace dsc::detail {
namespace {

using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::math::Vec3d;

std::string quoted(const NamedGrid& named) { return "the grid '" + named.name + "'"; }

/// Sets spacing, origin and direction.
void place(const NamedGrid& named, const Coord& first, ImageHeader& header) {
  const openvdb::math::Transform& transform = named.grid->constTransform();
  if (!transform.isLinear()) {
    throw ImageError(quoted(named) +
                     " lies in a frustum, where voxels are no boxes; resample it to a grid with a "
                     "linear transform");
  }
  // OpenVDB multiplies rows with the matrix: row a is where axis a of the voxels goes.
  const auto matrix = transform.baseMap()->getAffineMap()->getMat4();
  Vec3d axes[3];
  for (int a = 0; a < 3; ++a) {
    const Vec3d axis(matrix(a, 0), matrix(a, 1), matrix(a, 2));
    const double largest = std::max({std::abs(axis[0]), std::abs(axis[1]), std::abs(axis[2])});
    if (!(largest > 0) || !axis.isFinite()) {
      throw ImageError(quoted(named) + " has a transform that is singular or not finite");
    }
    axes[a] = axis / largest;  // so that the length of (s, 0, 0) is s to the last bit
    const double length = axes[a].length();
    header.spacing[a] = largest * length;
    axes[a] /= length;
    for (int i = 0; i < 3; ++i) header.direction[3 * i + a] = axes[a][i];
  }
  constexpr double kTolerance = 1e-3;  // that of rigid_map()
  for (int a = 0; a < 3; ++a) {
    if (std::abs(axes[a].dot(axes[(a + 1) % 3])) > kTolerance) {
      throw ImageError(quoted(named) +
                       " has a transform that shears voxels, which are then no boxes; resample it "
                       "to one that scales, turns and moves");
    }
  }
  const Vec3d origin = transform.indexToWorld(first);
  for (int i = 0; i < 3; ++i) header.origin[i] = origin[i];
}

/// The box that is read.
template <class Tree>
CoordBBox extent(const NamedGrid& named, const Tree& tree, bool level_set) {
  // The nodes below a root's children trust them to lie on a lattice; a damaged file may not.
  constexpr std::int32_t kMask = Tree::RootNodeType::ChildNodeType::DIM - 1;
  for (auto child = tree.root().cbeginChildAll(); child; ++child) {
    const Coord at = child.getCoord();
    if (((at[0] | at[1] | at[2]) & kMask) != 0) {
      throw ImageError(quoted(named) + " has a node off its lattice; the file is damaged");
    }
  }
  CoordBBox box;
  tree.evalActiveVoxelBoundingBox(box);
  if constexpr (std::is_floating_point_v<typename Tree::ValueType>) {
    if (level_set) {
      if (!(tree.background() > 0)) {
        throw ImageError(quoted(named) +
                         " is a level set whose background is not positive: its interior, where "
                         "values are negative, has no end");
      }
      for (auto value = tree.cbeginValueOff(); value; ++value) {
        if (*value < 0) box.expand(value.getBoundingBox());
      }
    }
  }
  if (box.empty()) throw ImageError(quoted(named) + " has no active voxel");
  return box;
}

/// \throws ImageTooLarge where the box has more voxels than bits of memory, or lies too far out.
void check_size(const NamedGrid& named, const CoordBBox& box, std::size_t bytes) {
  constexpr std::int32_t kFarthest = std::int32_t{1} << 30;  // beyond it OpenVDB's sums overflow
  std::ostringstream text;
  text << quoted(named) << " spans the voxels from " << box.min() << " to " << box.max();
  std::int64_t voxels = 1;
  bool counted = true;
  for (int a = 0; a < 3; ++a) {
    if (box.min()[a] < -kFarthest || box.max()[a] > kFarthest) {
      throw ImageTooLarge(text.str() + ", and those beyond 2^30 are not read; move or clip it");
    }
    const std::int64_t size = std::int64_t{box.max()[a]} - box.min()[a] + 1;
    counted = counted && !__builtin_mul_overflow(voxels, size, &voxels);
  }
  const auto memory = static_cast<std::size_t>(::sysconf(_SC_PHYS_PAGES)) *
                      static_cast<std::size_t>(::sysconf(_SC_PAGE_SIZE));
  if (counted && static_cast<std::size_t>(voxels) / 8 <= std::min(bytes, memory)) return;
  throw ImageTooLarge(text.str() +
                      ", and even one bit for each does not fit in the memory that is left; clip "
                      "or resample it");
}

template <class Tree, class Value>
class TreeImage final : public Image {
 public:
  TreeImage(NamedGrid named, typename Tree::ConstPtr tree, std::size_t bytes)
      : named_(std::move(named)), tree_(std::move(tree)) {
    const openvdb::GridClass grid_class = named_.grid->getGridClass();
    if (std::is_floating_point_v<Value>) {
      header_.volume_class = grid_class == openvdb::GRID_LEVEL_SET    ? 1
                             : grid_class == openvdb::GRID_FOG_VOLUME ? 2
                                                                      : 0;
    }
    box_ = extent(named_, *tree_, header_.volume_class == 1);
    check_size(named_, box_, bytes);
    std::memcpy(header_.start, kImageStart, sizeof kImageStart);
    for (int a = 0; a < 3; ++a) header_.size[a] = box_.dim()[a];
    header_.bytes = sizeof(Value);
    header_.kind = std::is_floating_point_v<Value> ? 2 : std::is_signed_v<Value> ? 1 : 0;
    place(named_, box_.min(), header_);
  }

  ImageHeader header() const override { return header_; }
  std::string part() const override { return named_.name; }

  void read(const TakeBytes& take) override {
    constexpr std::size_t kSlabBytes = std::size_t{4} << 20;
    constexpr std::int32_t kLeaf = Tree::LeafNodeType::DIM;
    const std::size_t slice =
        sizeof(Value) * static_cast<std::size_t>(header_.size[0] * header_.size[1]);
    const auto most = static_cast<std::int32_t>(
        std::clamp<std::size_t>(kSlabBytes / slice, 1, std::size_t{kLeaf}));
    std::vector<Value> buffer(slice / sizeof(Value) * static_cast<std::size_t>(most));
    for (std::int32_t first = box_.min()[2], last = 0; first <= box_.max()[2]; first = last + 1) {
      // A slab ends where leaf nodes do, so that each is visited once.
      last = std::min({first + most - 1, first | (kLeaf - 1), box_.max()[2]});
      const CoordBBox slab(Coord(box_.min()[0], box_.min()[1], first),
                           Coord(box_.max()[0], box_.max()[1], last));
      openvdb::tools::Dense<Value, openvdb::tools::LayoutXYZ> dense(slab, buffer.data());
      tree_->root().copyToDense(slab, dense);
      take(buffer.data(), slice * static_cast<std::size_t>(last - first + 1));
    }
  }

 private:
  NamedGrid named_;
  typename Tree::ConstPtr tree_;
  CoordBBox box_;
  ImageHeader header_{};
};

template <class Grid, class Value>
std::unique_ptr<Image> image_of(const NamedGrid& named, std::size_t bytes) {
  const auto grid = openvdb::gridPtrCast<Grid>(named.grid);
  if (!grid) return nullptr;
  return std::make_unique<TreeImage<typename Grid::TreeType, Value>>(named, grid->constTreePtr(),
                                                                     bytes);
}

/// A mask is what is active, whatever the values of its tiles.
std::unique_ptr<Image> image_of_mask(const NamedGrid& named, std::size_t bytes) {
  const auto grid = openvdb::gridPtrCast<openvdb::MaskGrid>(named.grid);
  if (!grid) return nullptr;
  auto tree =
      std::make_shared<openvdb::BoolTree>(grid->constTree(), false, true, openvdb::TopologyCopy());
  return std::make_unique<TreeImage<openvdb::BoolTree, std::uint8_t>>(named, tree, bytes);
}

}  // namespace

std::unique_ptr<Image> open_vdb_image(const ImageRequest& request) {
  openvdb::initialize();
  const NamedGrid named = VdbFile(request.path).read(request.part, request.bytes);
  std::unique_ptr<Image> image = image_of<openvdb::FloatGrid, float>(named, request.bytes);
  if (!image) image = image_of<openvdb::DoubleGrid, double>(named, request.bytes);
  if (!image) image = image_of<openvdb::Int32Grid, std::int32_t>(named, request.bytes);
  if (!image) image = image_of<openvdb::Int64Grid, std::int64_t>(named, request.bytes);
  if (!image) image = image_of<openvdb::BoolGrid, std::uint8_t>(named, request.bytes);
  if (!image) image = image_of_mask(named, request.bytes);
  if (!image) throw ImageError(quoted(named) + " is not of the type that the file says");
  return image;
}

std::string vdb_message(const std::exception& error) {
  if (dynamic_cast<const std::ios_base::failure*>(&error) != nullptr) {
    return "the file ends before its grids do; it is truncated or damaged";
  }
  return std::string("the file is damaged, or not of OpenVDB: ") + error.what();
}

}  // namespace dsc::detail
