// Medical and other images, read by the program dsc-image-reader (io/itk/) through a pipe.
#include "libdsc/base/checked.h"
#include "libdsc/base/error.h"
#include "libdsc/io/child_process.h"
#include "libdsc/io/image_stream.h"
#include "libdsc/io/standard_stream.h"
#include "libdsc/io/volume_formats.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <vector>

#include <unistd.h>

namespace dsc::detail {
namespace {

namespace fs = std::filesystem;

/// Where the reader may be: by the environment, beside the program, in the program's install tree,
/// in the one that the library was built for.
std::string find_reader(const std::string& image) {
  constexpr const char* kName = "dsc-image-reader";
  if (const char* named = std::getenv("DSC_IMAGE_READER"); named != nullptr && *named != '\0') {
    return named;
  }
  std::error_code error;
  const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  const fs::path places[] = {folder / kName, folder / ".." / DSC_LIBEXEC / "libdsc" / kName,
                             fs::path(DSC_FULL_LIBEXEC) / "libdsc" / kName};
  for (const fs::path& place : places) {
    if (::access(place.c_str(), X_OK) == 0) return place.string();
  }
  throw InputError("'" + image +
                   "': its format needs the program dsc-image-reader, which is not "
                   "there; build libdsc with -DDSC_WITH_ITK=ON, or name the program in the "
                   "variable DSC_IMAGE_READER");
}

/// The image, and the bytes of memory that the reader may take.
std::vector<std::string> reader_arguments(const std::string& path, const Context& context) {
  std::vector<std::string> words{fs::absolute(path).string()};
  if (context.memory != nullptr) words.push_back(std::to_string(context.memory->left()));
  return words;
}

/// Ten minutes, as a large compressed file on a slow disk may take, or what the environment says.
std::chrono::duration<double> patience() {
  const char* text = std::getenv("DSC_IMAGE_READER_SECONDS");
  if (text == nullptr || *text == '\0') return std::chrono::minutes(10);
  char* end = nullptr;
  const double seconds = std::strtod(text, &end);
  if (*end != '\0' || !(seconds > 0 && seconds < 1e9)) {
    throw UsageError("the variable DSC_IMAGE_READER_SECONDS is '" + std::string(text) +
                     "'; it must be a positive number of seconds");
  }
  return std::chrono::duration<double>(seconds);
}

class ImageSource final : public VolumeSource {
 public:
  ImageSource(const std::string& path, const Context& context)
      : path_(path), reader_(find_reader(path), reader_arguments(path, context)) {
    reader_.set_patience(patience());
    ImageHeader header;
    receive(&header, sizeof header, context);
    if (std::memcmp(header.start, kImageStart, sizeof kImageStart) != 0) {
      throw InputError("'" + path + "': what answered is no dsc-image-reader of this version");
    }
    try {
      take(header);
    } catch (const InputError& error) {
      throw InputError("'" + path + "': " + error.what());
    }
  }

  const std::string& path() const override { return path_; }
  const Grid& grid() const override { return grid_; }
  RigidMap world() const override { return world_; }
  bool x_fastest() const override { return true; }

  void read(const std::function<void(const Slab&)>& take_slab, const Context& context) override {
    stream_slabs(
        grid_.size[2], grid_.size[0] * grid_.size[1], type_,
        [&](void* to, Index bytes) { receive(to, bytes, context); }, take_slab, context);
    char end[sizeof kImageEnd];
    receive(end, sizeof end, context);
    char beyond = 0;
    if (std::memcmp(end, kImageEnd, sizeof end) != 0 || reader_.read(&beyond, 1, context) != 0) {
      throw InputError("'" + path_ + "': its reader sent more values than it had promised");
    }
    if (const auto ending = reader_.finish(context); !ending.why.empty()) fail(ending);
  }

 private:
  [[noreturn]] void fail(const ChildProcess::Ending& ending) const {
    const std::string text = "'" + path_ + "': " + ending.why;
    if (ending.too_large) throw LimitError(text);
    throw InputError(text);
  }

  void receive(void* to, Index bytes, const Context& context) {
    if (reader_.read(to, bytes, context) == bytes) return;
    auto ending = reader_.finish(context);
    if (ending.why.empty()) ending.why = "its reader ended before all values were there";
    fail(ending);
  }

  void take(const ImageHeader& header) {
    grid_.size = {header.size[0], header.size[1], header.size[2]};
    grid_.spacing = Vec3(header.spacing);
    grid_.check();
    for (const Index size : grid_.size) {
      if (size == 0) throw InputError("the image is empty");
    }
    type_.bytes = header.bytes;
    type_.is_signed = header.kind == 1;
    type_.is_float = header.kind == 2;
    const int least = type_.is_float ? 4 : 1;
    const bool known =
        header.bytes == 1 || header.bytes == 2 || header.bytes == 4 || header.bytes == 8;
    if (!known || header.bytes < least || header.kind < 0 || header.kind > 2) {
      throw InputError("values of " + std::to_string(header.bytes) + " bytes are not supported");
    }
    (void)checked_product(grid_.voxels(), type_.bytes, "bytes");
    Mat3 direction;
    for (int i = 0; i < 9; ++i) direction(i / 3, i % 3) = header.direction[i];
    world_ = rigid_map(direction, Vec3(header.origin));
  }

  std::string path_;
  ChildProcess reader_;
  Grid grid_;
  RigidMap world_;
  ValueType type_;
};

}  // namespace

bool is_image(const std::string& path) {
  std::string name = path;
  std::transform(name.begin(), name.end(), name.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  for (const char* ending :
       {".nii", ".nii.gz", ".nrrd", ".nhdr", ".mha", ".mhd", ".tif", ".tiff"}) {
    if (name.ends_with(ending)) return true;
  }
  std::error_code error;
  return fs::is_directory(path, error);
}

std::unique_ptr<VolumeSource> open_image(const std::string& path, const Context& context) {
  if (is_standard_stream(path)) {
    throw UsageError("'" + path + "': images are read from files, not from standard input");
  }
  if (!fs::exists(path)) throw InputError("cannot read '" + path + "': it does not exist");
  return std::make_unique<ImageSource>(path, context);
}

}  // namespace dsc::detail
