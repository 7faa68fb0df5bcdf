/// \file
/// \internal
/// The writer of each format, and what they share: bytes made in parallel, written in order.
/// Private: call write_result().
#pragma once

#include "libdsc/io/results.h"

#include <charconv>
#include <functional>
#include <string>
#include <vector>

namespace dsc {

class AtomicFile;

namespace detail {

/// Appends the bytes of the elements [first, last) to `out`.
using Encode = std::function<void(Index first, Index last, std::string& out)>;

/// Writes what `encode` makes of [0, n), cut into chunks of `grain`: a few chunks at a time are
/// made in parallel, then written in order, so that memory stays small whatever n is.
void write_in_chunks(AtomicFile& file, Index n, Index grain, const Encode& encode,
                     const Context& context);

void write_ply(AtomicFile& file, const Result& result, const Context& context);
void write_vtp(AtomicFile& file, const Result& result, const Context& context);
void write_csv(AtomicFile& file, const Result& result, FieldOn rows, const Context& context);
void write_off(AtomicFile& file, const Result& result, const Context& context);
void write_obj(AtomicFile& file, const Result& result, const Context& context);
void write_stl(AtomicFile& file, const Result& result, const Context& context);
/// \return the names of the fields that it cannot hold.
std::vector<std::string> write_om(AtomicFile& file, const Result& result, const Context& context);

/// Appends the bytes of `value` as they lie in memory: libdsc runs on little-endian machines only.
template <class T>
void append_bytes(std::string& out, const T& value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Appends an integer, or the shortest digits that read back to the same double.
template <class Number>
void append_number(std::string& out, Number value) {
  char digits[32];  // a double has at most 24 characters
  out.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

/// Three numbers with blanks between.
inline void append_numbers(std::string& out, const Vec3& v) {
  append_number(out, v[0]);
  for (const double coordinate : {v[1], v[2]}) {
    out += ' ';
    append_number(out, coordinate);
  }
}

}  // namespace detail
}  // namespace dsc
