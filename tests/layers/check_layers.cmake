# cmake -DROOT=<folder of the layers> -P check_layers.cmake
#
# Reads the #include lines of every source file under ROOT and fails, naming the file and the header, on
# each that the architecture forbids.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/../../cmake/PrivateHeaders.cmake)

# A layer uses itself and what comes before it here.
set(layers base voxels surface normals calculus solve algorithms truth io render page cli)

# Pairs: headers, and the only files (as <layer>/<file>) that may include them.
set(restricted
  "^OpenMesh/"                                    "^(surface/|io/|calculus/on_mesh\\.h$)"
  "^CGAL/"                                        "^truth/[^/]*\\.cpp$"
  "^libdsc/truth/"                                "^truth/"
  "^(fstream|cstdio|stdio\\.h|filesystem|fcntl\\.h|sys/.*|zlib\\.h)$"  "^(io|page|cli)/"
  "^(itk|gdcm)"                                   "^io/itk/"
  "^openvdb/"                                     "^io/vdb/"
  "^(tbb/|oneapi/|omp\\.h$|execution$|future$)"   "^base/"
  "^thread$"                                      "^(base|cli)/"
  "^(suitesparse/|cholmod|SuiteSparse|cblas|openblas)"  "^solve/cholmod_"
  "^embree"                                       "^render/tracer\\.cpp$"
  "^(png|pngconf|pnglibconf)\\.h$"                "^render/png_file\\.cpp$"
  # What dsc::dsc links privately stays out of the headers that are installed.
  "^(muParser|metis\\.h|fmt/|nlohmann/|CLI/|zlib\\.h|tbb/|oneapi/)"  "(\\.cpp$|^cli/)")

# Headers that are their layer's own: only its files, no public header among them, and the program may
# include these.
dsc_private_headers(${ROOT} private)

set(problems "")
file(GLOB_RECURSE files RELATIVE ${ROOT} ${ROOT}/*.h ${ROOT}/*.hpp ${ROOT}/*.cpp)
if(NOT files)
  message(FATAL_ERROR "no source files under ${ROOT}")
endif()
foreach(file IN LISTS files)
  string(REGEX REPLACE "/.*" "" layer "${file}")
  list(FIND layers "${layer}" rank)
  if(rank EQUAL -1)
    list(APPEND problems "${file}: ${layer} is not a layer")
    continue()
  endif()
  file(STRINGS ${ROOT}/${file} lines REGEX "^[ \t]*#[ \t]*include")
  foreach(line IN LISTS lines)
    if(NOT line MATCHES "include[ \t]*([<\"])([^>\"]+)[>\"]")
      list(APPEND problems "${file}: an include that this check cannot read: ${line}")
      continue()
    endif()
    set(quote "${CMAKE_MATCH_1}")
    set(header "${CMAKE_MATCH_2}")
    if(header MATCHES "^libdsc/(([a-z]+)/.*)$")
      set(used_header "${CMAKE_MATCH_1}")
      set(used_layer "${CMAKE_MATCH_2}")
      list(FIND layers "${used_layer}" used)
      if(used EQUAL -1 OR used GREATER rank)
        list(APPEND problems "${file}: includes ${header}, a layer after its own")
      elseif(used_header IN_LIST private AND NOT layer STREQUAL "cli")
        if(NOT layer STREQUAL used_layer)
          list(APPEND problems "${file}: includes ${header}, which is \\internal to its layer")
        elseif(file MATCHES "\\.h$" AND NOT file IN_LIST private)
          list(APPEND problems "${file}: includes ${header}, which is \\internal, and is public itself")
        endif()
      endif()
    elseif(quote STREQUAL "\"")
      list(APPEND problems "${file}: includes ${header} by another path than libdsc/<layer>/")
    endif()
    list(LENGTH restricted length)
    math(EXPR last "${length} - 1")
    foreach(i RANGE 0 ${last} 2)
      math(EXPR j "${i} + 1")
      list(GET restricted ${i} pattern)
      list(GET restricted ${j} allowed)
      if(header MATCHES "${pattern}" AND NOT file MATCHES "${allowed}")
        list(APPEND problems "${file}: includes ${header}, which only ${allowed} may")
      endif()
    endforeach()
  endforeach()
endforeach()

list(LENGTH files count)
if(problems)
  list(JOIN problems "\n  " text)
  message(FATAL_ERROR "against the layers:\n  ${text}")
endif()
message(STATUS "${count} files keep to the layers")
