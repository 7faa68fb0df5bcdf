#include <cholmod.h>  // wrong
