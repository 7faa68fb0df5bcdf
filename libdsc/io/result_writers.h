/// \file
/// The writer of each format, and what they share: bytes made in parallel, written in order.
/// Internal to io/; call write_result().
#pragma once

#include "libdsc/io/results.h"

#include <functional>
#include <string>

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

/// Appends the bytes of `value` as they lie in memory: libdsc runs on little-endian machines only.
template <class T>
void append_bytes(std::string& out, const T& value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

}  // namespace detail
}  // namespace dsc
