#include "libdsc/io/reader_source.h"

#include "libdsc/base/checked.h"
#include "libdsc/base/error.h"
#include "libdsc/io/child_process.h"
#include "libdsc/io/image_stream.h"
#include "libdsc/io/input_file.h"
#include "libdsc/io/standard_stream.h"
#include "libdsc/io/volume_formats.h"

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <limits>
#include <vector>

#include <unistd.h>

namespace dsc::detail {
namespace {

namespace fs = std::filesystem;

/// Where the program may be: by the environment, beside this one, in this one's install tree, in
/// the one that the library was built for.
std::string find_reader(const ReaderProgram& program, const std::string& file) {
  if (const char* named = std::getenv(program.variable); named != nullptr && *named != '\0') {
    return named;
  }
  std::error_code error;
  const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  const fs::path places[] = {folder / program.name,
                             folder / ".." / DSC_LIBEXEC / "libdsc" / program.name,
                             fs::path(DSC_FULL_LIBEXEC) / "libdsc" / program.name};
  for (const fs::path& place : places) {
    if (::access(place.c_str(), X_OK) == 0) return place.string();
  }
  throw InputError("'" + file + "': its format needs the program " + program.name +
                   ", which is not there; build libdsc with -D" + program.option +
                   "=ON, or name the program in the variable " + program.variable);
}

/// The file, the bytes of memory that the reader may take, and the part of the file.
std::vector<std::string> reader_arguments(const std::string& path,
                                          const std::optional<std::string>& part,
                                          const Context& context) {
  std::vector<std::string> words{fs::absolute(path).string()};
  if (context.memory != nullptr) {
    words.push_back(std::to_string(context.memory->left()));
  } else if (part) {
    words.push_back(std::to_string(std::numeric_limits<Index>::max()));
  }
  if (part) words.push_back(*part);
  return words;
}

/// Ten minutes, as a large compressed file on a slow disk may take, or what the environment says.
std::chrono::duration<double> patience(const std::string& variable) {
  const char* text = std::getenv(variable.c_str());
  if (text == nullptr || *text == '\0') return std::chrono::minutes(10);
  char* end = nullptr;
  const double seconds = std::strtod(text, &end);
  if (*end != '\0' || !(seconds > 0 && seconds < 1e9)) {
    throw UsageError("the variable " + variable + " is '" + std::string(text) +
                     "'; it must be a positive number of seconds");
  }
  return std::chrono::duration<double>(seconds);
}

class ReaderSource final : public VolumeSource {
 public:
  ReaderSource(const ReaderProgram& program, const std::string& path,
               const std::optional<std::string>& part, const Context& context)
      : path_(path), reader_(find_reader(program, path), reader_arguments(path, part, context)) {
    const std::string variable = std::string(program.variable) + "_SECONDS";
    reader_.set_patience(patience(variable), variable);
    ImageHeader header;
    receive(&header, sizeof header, context);
    if (std::memcmp(header.start, kImageStart, sizeof kImageStart) != 0) {
      throw InputError("'" + path + "': what answered is no " + program.name + " of this version");
    }
    try {
      take(header);
    } catch (const InputError& error) {
      throw InputError("'" + path + "': " + error.what());
    } catch (const LimitError& error) {
      throw LimitError("'" + path + "': " + error.what());
    }
    grid_name_.resize(static_cast<std::size_t>(header.name_bytes));
    receive(grid_name_.data(), header.name_bytes, context);
    grid_name_ = printable(std::move(grid_name_));
  }

  const std::string& path() const override { return path_; }
  const Grid& grid() const override { return grid_; }
  RigidMap world() const override { return world_; }
  VolumeClass volume_class() const override { return class_; }
  std::string grid_name() const override { return grid_name_; }
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
    const std::string text = "'" + path_ + "': " + printable(ending.why);
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
    if (header.volume_class < 0 || header.volume_class > 2 || header.name_bytes < 0 ||
        header.name_bytes > kLongestName) {
      throw InputError("its reader sent a header that is none");
    }
    class_ = static_cast<VolumeClass>(header.volume_class);
    Mat3 direction;
    for (int i = 0; i < 9; ++i) direction(i / 3, i % 3) = header.direction[i];
    world_ = rigid_map(direction, Vec3(header.origin));
  }

  std::string path_;
  ChildProcess reader_;
  Grid grid_;
  RigidMap world_;
  ValueType type_;
  VolumeClass class_ = VolumeClass::values;
  std::string grid_name_;
};

}  // namespace

std::unique_ptr<VolumeSource> open_by_reader(const ReaderProgram& program, const std::string& path,
                                             const std::optional<std::string>& part,
                                             const Context& context) {
  if (is_standard_stream(path)) {
    throw UsageError("'" + path + "': this format is read from files, not from standard input");
  }
  if (!fs::exists(path)) throw InputError("cannot read '" + path + "': it does not exist");
  return std::make_unique<ReaderSource>(program, path, part, context);
}

}  // namespace dsc::detail
