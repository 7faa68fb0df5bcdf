#include "libdsc/solve/spd_solver.h"
  #  include <cstdio>  // wrong
#include "libdsc/io/results.h"  // wrong
#include <thread>  // wrong
