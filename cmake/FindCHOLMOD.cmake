# CHOLMOD on OpenBLAS. SuiteSparse 5 has no CMake package in Debian. Defines CHOLMOD::CHOLMOD.
#
# OpenBLAS is a direct dependency, not only what libcholmod finds as "libblas": the reference BLAS,
# all that a bare system has, is an order of magnitude slower, and the number of threads is set
# through OpenBLAS's own openblas_set_num_threads (openblas_config.h and cblas.h, found here).
find_path(CHOLMOD_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse)
find_library(CHOLMOD_LIBRARY cholmod)
find_library(CHOLMOD_CONFIG_LIBRARY suitesparseconfig)
find_library(CHOLMOD_OPENBLAS_LIBRARY openblas PATH_SUFFIXES openblas-pthread openblas-openmp openblas)
# Beside each flavour of the library lies its own header.
get_filename_component(_cholmod_flavour "${CHOLMOD_OPENBLAS_LIBRARY}" REALPATH)
get_filename_component(_cholmod_flavour "${_cholmod_flavour}" DIRECTORY)
get_filename_component(_cholmod_flavour "${_cholmod_flavour}" NAME)
find_path(CHOLMOD_OPENBLAS_INCLUDE_DIR openblas_config.h
  PATH_SUFFIXES ${_cholmod_flavour} openblas-pthread openblas-openmp openblas)
unset(_cholmod_flavour)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(CHOLMOD
  REQUIRED_VARS CHOLMOD_LIBRARY CHOLMOD_INCLUDE_DIR CHOLMOD_CONFIG_LIBRARY
                CHOLMOD_OPENBLAS_LIBRARY CHOLMOD_OPENBLAS_INCLUDE_DIR
  REASON_FAILURE_MESSAGE
    "install SuiteSparse and OpenBLAS (Debian: libsuitesparse-dev libopenblas-dev)")
if(CHOLMOD_FOUND AND NOT TARGET CHOLMOD::CHOLMOD)
  add_library(CHOLMOD::CHOLMOD UNKNOWN IMPORTED)
  set_target_properties(CHOLMOD::CHOLMOD PROPERTIES
    IMPORTED_LOCATION "${CHOLMOD_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${CHOLMOD_INCLUDE_DIR};${CHOLMOD_OPENBLAS_INCLUDE_DIR}"
    INTERFACE_LINK_LIBRARIES "${CHOLMOD_OPENBLAS_LIBRARY};${CHOLMOD_CONFIG_LIBRARY}")
endif()
mark_as_advanced(CHOLMOD_INCLUDE_DIR CHOLMOD_LIBRARY CHOLMOD_CONFIG_LIBRARY
  CHOLMOD_OPENBLAS_LIBRARY CHOLMOD_OPENBLAS_INCLUDE_DIR)
