// Raw files: the values and nothing else; see RawLayout.
#include "libdsc/base/error.h"
#include "libdsc/io/data_size.h"
#include "libdsc/io/volume_formats.h"

#include <array>
#include <bit>
#include <utility>

namespace dsc {
namespace detail {
namespace {

class RawSource final : public VolumeSource {
 public:
  RawSource(InputFile file, const RawLayout& layout) : file_(std::move(file)), type_(layout.type) {
    const std::string& path = file_.path();
    grid_.size = layout.size;
    type_.swap =
        type_.bytes > 1 && layout.big_endian == (std::endian::native == std::endian::little);
    for (const Index size : grid_.size) {
      if (size <= 0) throw UsageError("'" + path + "': a raw volume needs three positive sizes");
    }
    if (layout.offset < 0) throw UsageError("'" + path + "': the offset must not be negative");
    const Index bytes = data_bytes(file_, 0, grid_, type_.bytes);
    const Index there = file_.size() - layout.offset;
    if (there != bytes) {
      const std::string after =
          layout.offset > 0 ? " after the first " + std::to_string(layout.offset) : "";
      throw InputError("'" + path + "': " + grid_.text() + " of " + std::to_string(type_.bytes) +
                       (type_.bytes == 1 ? " byte are " : " bytes are ") + std::to_string(bytes) +
                       " bytes, the file holds " + std::to_string(std::max<Index>(0, there)) +
                       after + "; check size, type and offset");
    }
    file_.seek(layout.offset);
  }

  const std::string& path() const override { return file_.path(); }
  const Grid& grid() const override { return grid_; }
  bool x_fastest() const override { return true; }
  void read(const std::function<void(const Slab&)>& take, const Context& context) override {
    stream_slabs(
        grid_.size[2], grid_.size[0] * grid_.size[1], type_,
        [&](void* to, Index bytes) { file_.read(to, bytes); }, take, context);
  }

 private:
  InputFile file_;
  Grid grid_;
  ValueType type_;
};

}  // namespace

std::unique_ptr<VolumeSource> open_raw(InputFile file, const RawLayout& layout) {
  return std::make_unique<RawSource>(std::move(file), layout);
}

}  // namespace detail

std::unique_ptr<VolumeSource> open_raw_volume(const std::string& path, const RawLayout& layout,
                                              const Context& context) {
  return detail::open_raw(InputFile(path, context), layout);
}

}  // namespace dsc
