// .vox of MagicaVoxel: chunks of four letters, the length of their content and of their children,
// little-endian. One model is read: its SIZE (x, y, z) and its XYZI, a list of (x, y, z, colour).
#include "libdsc/base/error.h"
#include "libdsc/io/volume_formats.h"

#include <span>
#include <vector>

namespace dsc::detail {
namespace {

class VoxSource final : public VolumeSource {
 public:
  explicit VoxSource(const std::string& path) : file_(path) {
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
    if (models_ == 1 && colours_.empty()) file_.fail(file_.size(), "the chunk XYZI is missing");
    if (models_ != 1) {
      file_.fail(0, "there are " + std::to_string(models_) +
                        " models in the file; one is read: save each to a file of its own");
    }
  }

  const std::string& path() const override { return file_.path(); }
  const Grid& grid() const override { return grid_; }
  bool x_fastest() const override { return true; }

  void read(const std::function<void(const Slab&)>& take, const Context& context) override {
    context.check();
    take(Slab{0, grid_.size[2], std::span<const std::uint8_t>(colours_)});
    context.advance(grid_.size[2]);
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
    if (!colours_.empty()) file_.fail(c.at, "a second chunk XYZI for one SIZE");
    const Index count = number();
    if (c.content != 4 + 4 * count) {
      file_.fail(c.at, "XYZI promises " + std::to_string(count) + " voxels in " +
                           std::to_string(c.content) + " bytes");
    }
    if (count > grid_.voxels()) {
      file_.fail(c.at, "XYZI promises " + std::to_string(count) + " voxels of " + grid_.text());
    }
    std::vector<unsigned char> list(static_cast<std::size_t>(4 * count));
    file_.read(list.data(), 4 * count);
    colours_.assign(static_cast<std::size_t>(grid_.voxels()), 0);
    for (Index i = 0; i < count; ++i) {
      const unsigned char* v = &list[static_cast<std::size_t>(4 * i)];
      const Index at = c.at + 16 + 4 * i;
      if (!grid_.contains(v[0], v[1], v[2])) file_.fail(at, "a voxel outside of SIZE");
      if (v[3] == 0) file_.fail(at, "a voxel of colour 0, which stands for none");
      auto& colour =
          colours_[static_cast<std::size_t>(v[0] + grid_.size[0] * (v[1] + grid_.size[1] * v[2]))];
      if (colour != 0) file_.fail(at, "a voxel that was there before");
      colour = v[3];
    }
  }

  InputFile file_;
  Grid grid_;
  Index models_ = 0;
  std::vector<std::uint8_t> colours_;
};

}  // namespace

std::unique_ptr<VolumeSource> open_vox(const std::string& path) {
  return std::make_unique<VoxSource>(path);
}

}  // namespace dsc::detail
