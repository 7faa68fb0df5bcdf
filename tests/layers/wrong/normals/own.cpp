#include "libdsc/normals/own.h"
