#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <cstdio>
#include <zlib.h>
#include "libdsc/cli/options.h"  // wrong
#include "libdsc/truth/mesh.h"  // wrong
#include "libdsc/render/picture.h"  // wrong
