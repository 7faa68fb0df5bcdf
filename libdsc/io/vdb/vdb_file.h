/// \file
/// \internal
/// An OpenVDB file, and the choice of one of its grids.
#pragma once

#include <openvdb/Grid.h>
#include <openvdb/io/Archive.h>
#include <openvdb/io/GridDescriptor.h>
#include <openvdb/io/io.h>

#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

namespace dsc::detail {

struct NamedGrid {
  std::string name;  ///< as people type it: NAME, or NAME[N] where several have that name
  openvdb::GridBase::Ptr grid;
};

/// openvdb::io::File takes what is missing at the end of a file for anything, and waits for no end
/// on a damaged one. Here every read that comes to the end of the file throws, and a grid's data
/// must lie where the file says.
class VdbFile : private openvdb::io::Archive {
 public:
  /// Reads the list of grids. \throws ImageError, std::ios_base::failure where the file ends too
  /// early, OpenVDB's exceptions.
  explicit VdbFile(const std::string& path);
  VdbFile(const VdbFile&) = delete;
  VdbFile& operator=(const VdbFile&) = delete;
  ~VdbFile() override = default;

  /// Reads one grid, its values too: the one of that name, else the only one whose values are
  /// numbers. \throws the same; ImageError says which names there are; ImageTooLarge where the file
  /// says that it needs more than `bytes` of memory.
  NamedGrid read(const std::optional<std::string>& name, std::size_t bytes);

 private:
  struct Entry {
    openvdb::io::GridDescriptor descriptor;
    openvdb::GridBase::Ptr grid;  ///< without its values until load()
  };

  void check_version() const;
  void read_entry();
  void load(Entry& entry);
  void check_memory(const Entry& entry, std::size_t bytes);
  Entry& choose(const std::optional<std::string>& name);
  Entry& choose_named(const std::string& name);
  std::string list_of(const std::vector<Entry*>& entries) const;
  std::vector<Entry*> all();

  std::ifstream file_;
  std::int64_t size_ = 0;
  openvdb::io::StreamMetadata::Ptr metadata_;  ///< the stream points to it
  std::vector<Entry> entries_;
};

}  // namespace dsc::detail
