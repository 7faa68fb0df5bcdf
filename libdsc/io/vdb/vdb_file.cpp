#include "libdsc/io/vdb/vdb_file.h"

#include "libdsc/io/reader_program.h"

#include <openvdb/openvdb.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

namespace dsc::detail {
namespace {

namespace io = openvdb::io;

/// As people type it.
std::string name_of(const io::GridDescriptor& descriptor) {
  return io::GridDescriptor::nameAsString(descriptor.uniqueName());
}

bool has_numbers(const std::string& type) {
  const std::string types[] = {openvdb::FloatGrid::gridType(), openvdb::DoubleGrid::gridType(),
                               openvdb::Int32Grid::gridType(), openvdb::Int64Grid::gridType(),
                               openvdb::BoolGrid::gridType(),  openvdb::MaskGrid::gridType()};
  return std::find(std::begin(types), std::end(types), type) != std::end(types);
}

/// "float" of Tree_float_5_4_3.
std::string value_type_of(const std::string& type) {
  const std::size_t start = type.find('_') + 1;
  const std::size_t end = type.find('_', start);
  return start == 0 || end == std::string::npos ? type : type.substr(start, end - start);
}

/// Why its values cannot be voxels.
std::string refusal(const io::GridDescriptor& descriptor) {
  const std::string type = value_type_of(descriptor.gridType());
  const std::string what = type.starts_with("vec")  ? "vectors (" + type + ")"
                           : type.starts_with("pt") ? "points (" + type + ")"
                                                    : "values of the type " + type;
  return "the grid '" + name_of(descriptor) + "' holds " + what +
         "; grids of float, double, int32, int64, bool or mask are read";
}

}  // namespace

VdbFile::VdbFile(const std::string& path) : metadata_(new io::StreamMetadata) {
  if (!std::filesystem::is_regular_file(path)) throw ImageError("it is no regular file");
  file_.open(path, std::ios_base::in | std::ios_base::binary);
  if (!file_) throw ImageError(std::string("it cannot be read: ") + std::strerror(errno));
  size_ = static_cast<std::int64_t>(std::filesystem::file_size(path));
  file_.exceptions(std::ios_base::failbit | std::ios_base::badbit | std::ios_base::eofbit);
  metadata_->setSeekable(true);
  io::setStreamMetadataPtr(file_, metadata_, false);
  readHeader(file_);
  check_version();
  setFormatVersion(file_);
  setLibraryVersion(file_);
  setDataCompression(file_);
  openvdb::MetaMap().readMeta(file_);
  const std::int32_t count = readGridCount(file_);
  if (count < 0) throw ImageError("the file is damaged: it has a negative number of grids");
  for (std::int32_t i = 0; i < count; ++i) read_entry();
}

void VdbFile::check_version() const {
  // OpenVDB goes on with a warning.
  if (fileVersion() <= openvdb::OPENVDB_FILE_VERSION) return;
  throw ImageError("its format has the version " + std::to_string(fileVersion()) +
                   ", this OpenVDB reads up to " + std::to_string(openvdb::OPENVDB_FILE_VERSION));
}

void VdbFile::read_entry() {
  Entry& entry = entries_.emplace_back();
  io::GridDescriptor& descriptor = entry.descriptor;
  entry.grid = descriptor.read(file_);
  if (!inputHasGridOffsets()) {  // what follows can only be found by reading it
    load(entry);
    return;
  }
  const std::int64_t here = file_.tellg();
  // What shares the voxels of another grid has no blocks.
  const std::int64_t blocks =
      descriptor.isInstance() ? descriptor.getGridPos() : descriptor.getBlockPos();
  const bool in_order = here <= descriptor.getGridPos() && descriptor.getGridPos() <= blocks &&
                        blocks <= descriptor.getEndPos();
  if (!in_order || descriptor.getEndPos() > size_) {
    throw ImageError("the data of the grid '" + name_of(descriptor) + "' should end at byte " +
                     std::to_string(descriptor.getEndPos()) + ", the file at byte " +
                     std::to_string(size_) + "; it is truncated or damaged");
  }
  descriptor.seekToEnd(file_);
}

void VdbFile::load(Entry& entry) {
  io::GridDescriptor& descriptor = entry.descriptor;
  if (inputHasGridOffsets()) descriptor.seekToGrid(file_);
  readGrid(entry.grid, descriptor, file_);
  if (inputHasGridOffsets() && file_.tellg() != descriptor.getEndPos()) {
    throw ImageError("the data of the grid '" + name_of(descriptor) + "' end at byte " +
                     std::to_string(file_.tellg()) + " and should at byte " +
                     std::to_string(descriptor.getEndPos()) + "; the file is damaged");
  }
}

/// Most files say what a grid takes. Where memory ends inside Blosc, it crashes.
void VdbFile::check_memory(const Entry& entry, std::size_t bytes) {
  entry.descriptor.seekToGrid(file_);
  readGridCompression(file_);
  openvdb::MetaMap facts;
  facts.readMeta(file_);
  const auto need =
      facts.getMetadata<openvdb::Int64Metadata>(openvdb::GridBase::META_FILE_MEM_BYTES);
  if (!need || need->value() < 0 || static_cast<std::size_t>(need->value()) <= bytes) return;
  throw ImageTooLarge("the grid '" + name_of(entry.descriptor) + "' takes " +
                      std::to_string(need->value()) + " bytes of memory, and " +
                      std::to_string(bytes) + " are left; use a part of it, or allow more");
}

NamedGrid VdbFile::read(const std::optional<std::string>& name, std::size_t bytes) {
  Entry& entry = choose(name);
  const io::GridDescriptor& descriptor = entry.descriptor;
  if (inputHasGridOffsets()) check_memory(entry, bytes);
  if (inputHasGridOffsets()) load(entry);
  if (descriptor.isInstance()) {  // its voxels are those of another grid
    const auto parent = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& other) {
      return other.descriptor.uniqueName() == descriptor.instanceParentName();
    });
    if (parent == entries_.end() || parent->descriptor.isInstance() ||
        parent->descriptor.gridType() != descriptor.gridType()) {
      throw ImageError("the grid '" + name_of(descriptor) +
                       "' shares the voxels of one that is not there; the file is damaged");
    }
    if (inputHasGridOffsets()) load(*parent);
    entry.grid->setTree(parent->grid->baseTreePtr());
  }
  return {name_of(descriptor), entry.grid};
}

std::vector<VdbFile::Entry*> VdbFile::all() {
  std::vector<Entry*> entries;
  for (Entry& entry : entries_) entries.push_back(&entry);
  return entries;
}

std::string VdbFile::list_of(const std::vector<Entry*>& entries) const {
  std::string list;
  for (const Entry* entry : entries) {
    list += (list.empty() ? "'" : ", '") + name_of(entry->descriptor) + "' (" +
            value_type_of(entry->descriptor.gridType()) + ")";
  }
  return list;
}

VdbFile::Entry& VdbFile::choose(const std::optional<std::string>& name) {
  if (entries_.empty()) throw ImageError("the file holds no grid");
  if (name) return choose_named(*name);
  std::vector<Entry*> usable = all();
  std::erase_if(usable,
                [](const Entry* entry) { return !has_numbers(entry->descriptor.gridType()); });
  if (usable.size() == 1) return *usable.front();
  if (usable.empty()) throw ImageError(refusal(entries_.front().descriptor));
  throw ImageError("the file holds the grids " + list_of(usable) +
                   "; choose one of them by its name (--grid NAME, VolumeOptions::grid)");
}

VdbFile::Entry& VdbFile::choose_named(const std::string& name) {
  const auto keep = [&](auto name_of_descriptor) {
    std::vector<Entry*> kept = all();
    std::erase_if(
        kept, [&](const Entry* entry) { return name_of_descriptor(entry->descriptor) != name; });
    return kept;
  };
  std::vector<Entry*> named = keep(name_of);
  if (named.empty()) named = keep([](const auto& descriptor) { return descriptor.gridName(); });
  if (named.empty()) {
    throw ImageError("the file has no grid '" + name + "'; it holds " + list_of(all()));
  }
  if (named.size() > 1) {
    throw ImageError("the file has more than one grid '" + name + "'; choose one of " +
                     list_of(named));
  }
  Entry& entry = *named.front();
  if (!has_numbers(entry.descriptor.gridType())) throw ImageError(refusal(entry.descriptor));
  return entry;
}

}  // namespace dsc::detail
