#include <vector>
#include <oneapi/tbb/parallel_for.h>  // wrong
#include "libdsc/voxels/grid.h"  // wrong
