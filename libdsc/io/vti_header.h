/// \file
/// \internal
/// What the XML of a .vti file (VTK's ImageData) says of its array of voxels. Private to io/.
#pragma once

#include "libdsc/io/input_file.h"
#include "libdsc/io/volume_source.h"

#include <string>

namespace dsc::detail {

enum class VtiEncoding { ascii, base64, raw };

struct VtiHeader {
  Grid grid;  ///< origin 0
  RigidMap world;
  ValueType type;
  VtiEncoding encoding = VtiEncoding::raw;
  Index begin = 0;          ///< the byte of the file at which the array begins
  bool compressed = false;  ///< by zlib, in blocks
  int word_bytes = 4;       ///< of the sizes before the data
  bool swap_words = false;  ///< their byte order is not this machine's
};

/// Reads the XML, up to the data that is appended to it. The array is the one that the attribute
/// Scalars names, of the points or else of the cells, or the only one that has one component.
/// \throws InputError naming the byte, also where the file is no XML or ends before.
VtiHeader read_vti_header(InputFile& file);

}  // namespace dsc::detail
