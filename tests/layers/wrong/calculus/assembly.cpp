#include "libdsc/surface/flat_mesh.h"
#include "libdsc/solve/spd_solver.h"  // wrong
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>  // wrong
#include <CGAL/Surface_mesh.h>  // wrong
