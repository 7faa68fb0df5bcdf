#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <muParser.h>  // wrong
