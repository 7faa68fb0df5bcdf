#include <CGAL/Surface_mesh.h>  // wrong
#include <vector>
