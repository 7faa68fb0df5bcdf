#include <CGAL/Surface_mesh.h>
#include "libdsc/truth/mesh.h"
#include "libdsc/io/results.h"  // wrong
