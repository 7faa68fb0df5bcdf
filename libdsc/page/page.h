/// \file
/// A result as a page: one .html file that holds the surface, its fields and the program that shows
/// them, and that a browser opens without a network.
///
/// The page turns the surface, colours it by a field with isolines, cuts it by a plane, shows two
/// fields side by side and reads the values at a vertex or a face. Integers of faces whose field's
/// name begins with `label` are told apart by hue; infinite values are grey. It needs WebGL and
/// DecompressionStream (browsers since 2023). Positions and values are kept as arrays.h says, so
/// that what the page reads out is right to about seven digits.
#pragma once

#include "libdsc/io/results.h"

#include <string>

namespace dsc {

/// Whether this build writes pages (DSC_WITH_PAGE). Where it does not, the functions below throw
/// UsageError, naming the option.
bool has_pages();

/// Whether the ending of `path` is .html or .htm, upper or lower case, or `path` is `html:-`,
/// standard output.
bool is_page_path(const std::string& path);

/// Refuses a path before anything is computed. \throws UsageError without pages; OutputError as
/// check_writable() of atomic_file.h.
void check_page_path(const std::string& path);

/// Writes `result` with all its fields; the normals of its mesh, where it has some, are those that
/// the page shades by. The file's name is the title.
/// \throws as write_result(), LimitError beyond 2^31 - 1 corners. In every case the file at `path`
/// is as it was before.
void write_page(const std::string& path, const Result& result, const Context& context = {});

}  // namespace dsc
