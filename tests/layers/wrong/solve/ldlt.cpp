#include <cholmod.h>  // wrong
#include "libdsc/normals/own.h"  // wrong
