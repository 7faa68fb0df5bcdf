// .vox of MagicaVoxel: chunks of four letters, the length of their content and of their children,
// little-endian. One model is read: its SIZE (x, y, z) and its XYZI, a list of (x, y, z, colour).
#include "libdsc/base/error.h"
#include "libdsc/io/volume_formats.h"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

namespace dsc::detail {
namespace {

class VoxSource final : public VolumeSource {
 public:
  explicit VoxSource(InputFile file) : file_(std::move(file)) {
    if (file_.size() < 20) file_.fail(file_.size(), "the file is too short for a .vox file");
    if (name() != "VOX ") file_.fail(0, "the magic bytes 'VOX ' of a .vox file are missing");
    (void)number();  // the version: models are the same in 150 and 200
    const Chunk main = chunk();
    if (main.name != "MAIN") file_.fail(main.at, "the chunk MAIN is missing");
    if (main.content != 0 || main.children != file_.remaining()) {
      file_.fail(main.at, "MAIN promises " + std::to_string(main.content + main.children) +
                              " bytes, " + std::to_string(file_.remaining()) +
                              " follow; the file is truncated or too long");
    }
    while (file_.remaining() > 0) read_chunk();
    if (models_ == 1 && !has_voxels_) file_.fail(file_.size(), "the chunk XYZI is missing");
    if (models_ != 1) {
      file_.fail(0, "there are " + std::to_string(models_) +
                        " models in the file; one is read: save each to a file of its own");
    }
  }

  const std::string& path() const override { return file_.path(); }
  const Grid& grid() const override { return grid_; }
  bool x_fastest() const override { return true; }

  void read(const std::function<void(const Slab&)>& take, const Context& context) override {
    const std::vector<std::uint8_t> colours = read_colours(context);
    const std::span<const std::uint8_t> all(colours);
    const auto per_slice = static_cast<std::size_t>(grid_.size[0] * grid_.size[1]);
    for (Index z = 0; z < grid_.size[2]; ++z) {
      context.check();
      take(Slab{z, z + 1, all.subspan(static_cast<std::size_t>(z) * per_slice, per_slice)});
      context.advance(1);
    }
  }

 private:
  struct Chunk {
    Index at = 0;
    std::string name;
    Index content = 0, children = 0;
  };

  std::string name() {
    std::string four(4, '\0');
    file_.read(four.data(), 4);
    return four;
  }
  Index number() {
    unsigned char b[4];
    file_.read(b, 4);
    return b[0] | b[1] << 8 | b[2] << 16 | static_cast<Index>(b[3]) << 24;
  }
  Chunk chunk() {
    Chunk c;
    c.at = file_.position();
    c.name = name();
    c.content = number();
    c.children = number();
    return c;
  }

  void read_chunk() {
    const Chunk c = chunk();
    const Index end = file_.position() + c.content + c.children;
    if (end > file_.size()) {
      file_.fail(c.at, "the chunk " + c.name + " goes on after the end of the file");
    }
    if (c.name == "SIZE") {
      read_size(c);
    } else if (c.name == "XYZI") {
      read_voxels(c);
    }
    file_.seek(end);
  }

  void read_size(const Chunk& c) {
    if (++models_ > 1) return;
    if (c.content != 12) file_.fail(c.at, "the chunk SIZE must hold 12 bytes");
    for (Index& size : grid_.size) {
      size = number();
      if (size < 1 || size > 256) {
        file_.fail(c.at, "SIZE: " + std::to_string(size) + " is not from 1 to 256");
      }
    }
  }

  void read_voxels(const Chunk& c) {
    if (models_ > 1) return;
    if (models_ == 0) file_.fail(c.at, "the chunk XYZI comes before any SIZE");
    if (has_voxels_) file_.fail(c.at, "a second chunk XYZI for one SIZE");
    const Index count = number();
    if (c.content != 4 + 4 * count) {
      file_.fail(c.at, "XYZI promises " + std::to_string(count) + " voxels in " +
                           std::to_string(c.content) + " bytes");
    }
    if (count > grid_.voxels()) {
      file_.fail(c.at, "XYZI promises " + std::to_string(count) + " voxels of " + grid_.text());
    }
    if (4 * count > file_.remaining()) file_.fail(c.at, "XYZI goes on after the end of the file");
    has_voxels_ = true;
    list_ = file_.position();
    count_ = count;
  }

  /// The colour of each voxel of the grid, at most 16 MB; 0 where none is.
  std::vector<std::uint8_t> read_colours(const Context& context) {
    context.need("read", grid_.voxels());
    std::vector<std::uint8_t> colours(static_cast<std::size_t>(grid_.voxels()), 0);
    constexpr Index kAtOnce = 1 << 16;
    std::vector<unsigned char> list(static_cast<std::size_t>(4 * std::min(count_, kAtOnce)));
    file_.seek(list_);
    for (Index i = 0; i < count_; ++i) {
      const Index at = list_ + 4 * i;
      if (i % kAtOnce == 0) {
        context.check();
        file_.read(list.data(), 4 * std::min(count_ - i, kAtOnce));
      }
      const unsigned char* v = &list[static_cast<std::size_t>(4 * (i % kAtOnce))];
      if (!grid_.contains(v[0], v[1], v[2])) file_.fail(at, "a voxel outside of SIZE");
      if (v[3] == 0) file_.fail(at, "a voxel of colour 0, which stands for none");
      const Index place = v[0] + grid_.size[0] * (v[1] + grid_.size[1] * v[2]);
      std::uint8_t& colour = colours[static_cast<std::size_t>(place)];
      if (colour != 0) file_.fail(at, "a voxel that was there before");
      colour = v[3];
    }
    return colours;
  }

  InputFile file_;
  Grid grid_;
  Index models_ = 0;
  Index list_ = 0, count_ = 0;  ///< where the voxels lie in the file, four bytes each
  bool has_voxels_ = false;
};

}  // namespace

std::unique_ptr<VolumeSource> open_vox(InputFile file) {
  return std::make_unique<VoxSource>(std::move(file));
}

}  // namespace dsc::detail
