// .vti, of VTK: see volume_source.h for what is read.
#include "libdsc/base/error.h"
#include "libdsc/io/data_size.h"
#include "libdsc/io/volume_formats.h"
#include "libdsc/io/vti_data.h"

#include <utility>

namespace dsc::detail {
namespace {

class VtiSource final : public VolumeSource {
 public:
  explicit VtiSource(InputFile file) : file_(std::move(file)), header_(read_vti_header(file_)) {
    bytes_ = data_bytes(file_, 0, header_.grid, header_.type.bytes);
    check_vti_room(file_, header_, bytes_);
  }

  const std::string& path() const override { return file_.path(); }
  const Grid& grid() const override { return header_.grid; }
  RigidMap world() const override { return header_.world; }
  bool x_fastest() const override { return true; }

  void read(const std::function<void(const Slab&)>& take, const Context& context) override {
    VtiData data(file_, header_, bytes_, context);
    const Index3& size = header_.grid.size;
    stream_slabs(
        size[2], size[0] * size[1], header_.type,
        [&](void* to, Index bytes) { data.next(to, bytes); }, take, context);
    data.finish();
  }

 private:
  InputFile file_;
  VtiHeader header_;
  Index bytes_ = 0;
};

}  // namespace

std::unique_ptr<VolumeSource> open_vti(InputFile file) {
  return std::make_unique<VtiSource>(std::move(file));
}

}  // namespace dsc::detail
