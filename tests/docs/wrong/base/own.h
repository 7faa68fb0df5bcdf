/// \file
/// \internal
/// A header of the layer's own: nothing has to be said of its names.
#pragma once

namespace dsc {
struct Hidden {};
}  // namespace dsc
