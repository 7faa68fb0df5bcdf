#include <embree3/rtcore.h>  // wrong
#include <png.h>  // wrong
#include "libdsc/io/results.h"
#include "libdsc/cli/options.h"  // wrong
