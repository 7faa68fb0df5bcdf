/// \file
/// \internal
/// Integers packed small for a page: each is predicted by one before it, and only the differences
/// are kept.
///
/// A block is made of `components` lists of n integers, given interleaved: value i of component c
/// is values[i * components + c].
///
/// 1. d = value i − value i − 1 of the same component (i = 0: the value), modulo 2^32;
/// 2. z = (d << 1) ^ (d >> 31, arithmetic): small differences of either sign become small numbers;
/// 3. the lowest bytes of all z of component 0, of component 1, …, then their second bytes, and so
/// on: 4 · n · components bytes, whose later parts are mostly 0;
/// 4. zlib.
///
/// Lossless for any integers. The page's codec.js is the reader.
#pragma once

#include "libdsc/base/context.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace dsc::detail {

/// Steps 1 to 3. \pre `values` has a multiple of `components` elements.
std::string byte_planes(std::span<const std::int32_t> values, std::size_t components);

/// Step 4: a zlib stream. \throws std::bad_alloc; Cancelled.
std::string deflated(std::string_view bytes, const Context& context = {});

/// All four steps.
std::string packed(std::span<const std::int32_t> values, std::size_t components,
                   const Context& context = {});

}  // namespace dsc::detail
