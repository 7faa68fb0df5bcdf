# cmake -DDOXYGEN=<program> -DROOT=<source tree> -DOUTPUT=<folder> [-DMATHJAX=<folder>]
#       [-DLAYERS=<folder>] -P doxygen.cmake
#
# Makes the pages in OUTPUT/html, with the parts of MathJax that they ask for beside them; without
# MATHJAX, only finds out whether they could be made. Fails on every warning: on a public name without
# a comment, a link that leads nowhere. LAYERS: these headers alone instead of the library's.
cmake_minimum_required(VERSION 3.25)
if(DEFINED MATHJAX AND NOT EXISTS ${MATHJAX}/jax/output/SVG/jax.js)
  message(FATAL_ERROR "${MATHJAX} has no MathJax 2, which sets the formulas (Debian: libjs-mathjax)")
endif()
include(${ROOT}/cmake/PrivateHeaders.cmake)
if(NOT DOXYGEN)
  message(STATUS "skipped: no doxygen")
  return()
endif()

file(STRINGS ${ROOT}/CMakeLists.txt version REGEX "^project\\(libdsc VERSION ")
string(REGEX REPLACE "^.*VERSION ([0-9.]+).*$" "\\1" version "${version}")

if(DEFINED LAYERS)
  set(inputs ${LAYERS})
else()
  set(LAYERS ${ROOT}/libdsc)
  set(inputs "")  # in the order of the pages
  foreach(page README docs/manual docs/ARCHITECTURE docs/layers CONTRIBUTING tests/RELIABILITY
          tests/benchmarks/RESULTS examples/experiments/RESULTS CHANGELOG)
    list(APPEND inputs ${ROOT}/${page}.md)
  endforeach()
  list(APPEND inputs ${ROOT}/docs/manual ${ROOT}/docs/layers ${OUTPUT}/examples.dox ${LAYERS})
endif()

# Private are the headers of the program, dsc, and those marked so.
dsc_private_headers(${LAYERS} private)
set(exclude ${LAYERS}/cli)
foreach(header IN LISTS private)
  list(APPEND exclude ${LAYERS}/${header})
endforeach()

# Every numbered example is a chapter: \ref fails where docs/manual has none of that name.
set(examples "")
file(GLOB sources RELATIVE ${ROOT}/examples ${ROOT}/examples/[0-9]*.cpp)
foreach(source IN LISTS sources)
  string(REPLACE ".cpp" "" name ${source})
  string(APPEND examples "/** \\example ${source}\nIn the manual: \\ref manual_${name}. */\n")
endforeach()
file(WRITE ${OUTPUT}/examples.dox "${examples}")

list(JOIN inputs "\" \"" inputs)
list(JOIN exclude "\" \"" exclude)
set(html NO)
if(DEFINED MATHJAX)
  set(html YES)
endif()
file(REMOVE_RECURSE ${OUTPUT}/html ${OUTPUT}/xml)
configure_file(${ROOT}/docs/Doxyfile.in ${OUTPUT}/Doxyfile @ONLY)
execute_process(COMMAND ${DOXYGEN} ${OUTPUT}/Doxyfile WORKING_DIRECTORY ${OUTPUT} RESULT_VARIABLE result)

# What doxygen 1.9.4 does not ask: values of enumerations.
file(GLOB pages ${OUTPUT}/xml/*.xml)
set(space "[ \n]*")
foreach(page IN LISTS pages)
  file(READ ${page} text)
  string(REPLACE ";" "," text "${text}")
  string(REGEX MATCHALL "<enumvalue [^>]*>${space}<name>[^<]*</name>(${space}<initializer>[^<]*</initializer>)?\
${space}<briefdescription>${space}</briefdescription>${space}<detaileddescription>${space}</detaileddescription>" bare "${text}")
  string(REGEX MATCH "<compoundname>([^<]*)" scope "${text}")
  set(scope ${CMAKE_MATCH_1})
  foreach(value IN LISTS bare)
    string(REGEX MATCH "<name>([^<]*)" value "${value}")
    message(SEND_ERROR "Value ${CMAKE_MATCH_1} of an enumeration of ${scope} is not documented.")
  endforeach()
endforeach()
if(NOT result EQUAL 0)
  message(FATAL_ERROR "doxygen has something to say (above): a public name without a comment? Give it one, "
                      "or mark its header as the layer's own (docs/ARCHITECTURE.md).")
endif()

if(DEFINED MATHJAX)
  set(beside ${OUTPUT}/html/mathjax)
  foreach(part MathJax.js extensions jax/input/TeX jax/element jax/output/SVG/jax.js jax/output/SVG/config.js
               jax/output/SVG/autoload jax/output/SVG/fonts/TeX)
    cmake_path(GET part PARENT_PATH folder)
    file(COPY ${MATHJAX}/${part} DESTINATION ${beside}/${folder} FOLLOW_SYMLINK_CHAIN)
  endforeach()
  message(STATUS "The pages: ${OUTPUT}/html/index.html")
endif()
