# Finds what libdsc needs and, where something is missing, names all of it at once with the Debian
# package that brings it.

set(_dsc_missing "")

# dsc_require(<package> <debian package> [<further find_package arguments>…])
macro(dsc_require package debian)
  find_package(${package} ${ARGN} QUIET)
  if(NOT ${package}_FOUND)
    string(APPEND _dsc_missing "\n  ${package} (Debian: ${debian})")
  endif()
endmacro()

dsc_require(Eigen3 libeigen3-dev 3.4 NO_MODULE)
dsc_require(OpenMesh libopenmesh-dev)
dsc_require(ZLIB zlib1g-dev)
dsc_require(METIS libmetis-dev)
dsc_require(muparser libmuparser-dev)
dsc_require(fmt libfmt-dev)
dsc_require(Spectra libspectra-dev)
find_package(Threads REQUIRED)
if(DSC_PARALLEL STREQUAL "TBB")
  dsc_require(TBB libtbb-dev)
elseif(NOT DSC_PARALLEL STREQUAL "STD")
  message(FATAL_ERROR "DSC_PARALLEL is '${DSC_PARALLEL}': choose TBB or STD")
endif()
if(DSC_BUILD_CLI)
  dsc_require(CLI11 libcli11-dev)
  dsc_require(nlohmann_json nlohmann-json3-dev)
endif()
if(DSC_BUILD_TESTS)
  dsc_require(GTest libgtest-dev)
endif()
if(DSC_WITH_CHOLMOD)
  dsc_require(CHOLMOD "libsuitesparse-dev libopenblas-dev")
endif()

if(DSC_WITH_ITK)  # its targets: libdsc/io/itk/
  find_package(ITK 5 QUIET COMPONENTS ITKIOImageBase)
  if(NOT ITK_FOUND)
    string(APPEND _dsc_missing "\n  ITK 5 (Debian: libinsighttoolkit5-dev)")
  endif()
endif()

if(_dsc_missing)
  message(FATAL_ERROR "libdsc needs what this system does not have:${_dsc_missing}\n"
    "On Debian, ./cmake/bootstrap.sh test installs all of it.")
endif()
