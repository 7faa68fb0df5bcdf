/// \file
/// \internal
/// A header of the layer's own.
#pragma once
