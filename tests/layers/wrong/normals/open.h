/// \file
/// A public header that shows its layer's own one to everybody.
#pragma once

#include "libdsc/normals/own.h"  // wrong
