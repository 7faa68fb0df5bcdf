# OpenVDB's own module is not where CMake looks, and Debian's package does not bring the headers of Boost
# that its headers include. Defines OpenVDB::openvdb.
find_path(OpenVDB_INCLUDE_DIR openvdb/openvdb.h)
find_path(OpenVDB_BOOST_INCLUDE_DIR boost/uuid/uuid.hpp)
find_library(OpenVDB_LIBRARY openvdb)
find_package(TBB QUIET)
find_package(Imath CONFIG QUIET)  # not needed where OpenVDB has its own half
if(OpenVDB_INCLUDE_DIR AND EXISTS ${OpenVDB_INCLUDE_DIR}/openvdb/version.h)
  file(STRINGS ${OpenVDB_INCLUDE_DIR}/openvdb/version.h _openvdb_versions
    REGEX "define OPENVDB_LIBRARY_(MAJOR|MINOR)_VERSION_NUMBER [0-9]+")
  string(REGEX REPLACE "[^;]* ([0-9]+);[^;]* ([0-9]+)" "\\1.\\2" OpenVDB_VERSION "${_openvdb_versions}")
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenVDB
  REQUIRED_VARS OpenVDB_LIBRARY OpenVDB_INCLUDE_DIR OpenVDB_BOOST_INCLUDE_DIR TBB_FOUND
  VERSION_VAR OpenVDB_VERSION
  REASON_FAILURE_MESSAGE "install OpenVDB, oneTBB and Boost (Debian: libopenvdb-dev libtbb-dev libboost-dev)")
if(OpenVDB_FOUND AND NOT TARGET OpenVDB::openvdb)
  add_library(OpenVDB::openvdb UNKNOWN IMPORTED)
  set_target_properties(OpenVDB::openvdb PROPERTIES IMPORTED_LOCATION "${OpenVDB_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${OpenVDB_INCLUDE_DIR};${OpenVDB_BOOST_INCLUDE_DIR}"
    INTERFACE_LINK_LIBRARIES "TBB::tbb;$<TARGET_NAME_IF_EXISTS:Imath::Imath>")
endif()
mark_as_advanced(OpenVDB_INCLUDE_DIR OpenVDB_BOOST_INCLUDE_DIR OpenVDB_LIBRARY)
