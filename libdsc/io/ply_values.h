/// \file
/// \internal
/// The values of a PLY file's elements, text or binary alike.
#pragma once

#include "libdsc/io/ply_header.h"

#include <memory>

namespace dsc::detail {

/// Every type of PLY fits a double, so that one function reads them all.
class PlyValues {
 public:
  PlyValues() = default;
  PlyValues(const PlyValues&) = delete;
  PlyValues& operator=(const PlyValues&) = delete;
  virtual ~PlyValues() = default;

  /// An upper bound of how many elements like this the rest of the file can hold.
  virtual Index room_for(const PlyElement& element) const = 0;
  /// An element begins; `name` and `number` are for messages.
  virtual void begin(const std::string& name, Index number) = 0;
  virtual double next(PlyType type) = 0;
  virtual void skip_list(Index items, PlyType type) = 0;
  /// The element must be read.
  virtual void end() = 0;
  /// The file must be.
  virtual void finish() = 0;
  /// \throws InputError about the element that was begun, or the value that was read last.
  [[noreturn]] virtual void fail(const std::string& why) const = 0;

  /// A list's length.
  Index length(PlyType type);
};

/// `lines` has just read the header of `file`, and `on_read` is called with each block's bytes.
std::unique_ptr<PlyValues> open_ply_values(PlyEncoding encoding, InputFile& file, TextLines& lines,
                                           const std::function<void(Index)>& on_read);

}  // namespace dsc::detail
