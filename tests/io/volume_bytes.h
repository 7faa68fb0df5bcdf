/// \file
/// Volume files written byte by byte, independently of the library's writers.
#pragma once

#include "libdsc/base/error.h"
#include "libdsc/base/types.h"
#include "libdsc/io/volume_source.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace dsc {

inline std::string vol_text(const std::string& sizes, const std::string& version) {
  return sizes +
         "Voxel-Size: 1\nAlpha-Color: 0\nVoxel-Endian: 0\nInt-Endian: 0123\nVersion: " + version +
         "\n.\n";
}

inline std::string vol_text(Index x, Index y, Index z, int version) {
  return vol_text(
      "X: " + std::to_string(x) + "\nY: " + std::to_string(y) + "\nZ: " + std::to_string(z) + "\n",
      std::to_string(version));
}

/// All voxels in the order in which they come.
inline std::vector<double> values_of(VolumeSource& source) {
  std::vector<double> all;
  source.read([&](const Slab& slab) {
    std::visit([&](auto span) { all.insert(all.end(), span.begin(), span.end()); }, slab.values);
  });
  return all;
}

inline std::string deflated(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string out(size, '\0');
  if (compress(reinterpret_cast<Bytef*>(out.data()), &size,
               reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()) != Z_OK) {
    throw Error("compress");
  }
  out.resize(size);
  return out;
}

/// `value` in `bytes` bytes, least significant first.
inline std::string little_endian(std::uint64_t value, int bytes) {
  std::string out;
  for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> (8 * i) & 255);
  return out;
}

inline std::string npy_text(int version, const std::string& dictionary) {
  std::string out = "\x93NUMPY";
  out += static_cast<char>(version);
  out += '\0';
  return out + little_endian(dictionary.size(), version == 1 ? 2 : 4) + dictionary;
}

inline std::string dictionary(const std::string& descr, bool fortran, const std::string& shape) {
  return "{'descr': '" + descr + "', 'fortran_order': " + (fortran ? "True" : "False") +
         ", 'shape': " + shape + ", }   \n";
}

/// Expects that `call` throws an Expected whose message has all of `parts`.
template <class Expected, class Call>
void expect_error(const Call& call, const std::vector<std::string>& parts) {
  try {
    call();
    ADD_FAILURE() << "nothing was thrown";
  } catch (const Expected& e) {
    for (const std::string& part : parts) {
      EXPECT_NE(std::string(e.what()).find(part), std::string::npos)
          << "'" << part << "' is not in: " << e.what();
    }
  }
}

template <class Call>
void expect_input_error(const Call& call, const std::vector<std::string>& parts) {
  expect_error<InputError>(call, parts);
}

}  // namespace dsc
