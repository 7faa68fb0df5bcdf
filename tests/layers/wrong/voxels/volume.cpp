#include "libdsc/base/types.h"
#include "libdsc/voxels/volume.h"
#include "volume.h"  // wrong
#include <fstream>  // wrong
#include <muParser.h>
