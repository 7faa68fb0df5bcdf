# cmake -DCHECK=<check_layers.cmake> -DROOT=<a tree with mistakes> -P check_wrong.cmake
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/../wrong_lines.cmake)
expect_failure("a tree with mistakes" ${CMAKE_COMMAND} -DROOT=${ROOT} -P ${CHECK})
# CMake breaks long lines of its messages; undo that.
string(REGEX REPLACE "[ \n]+" " " output "${output}")

function(is_reported file number line result)
  string(REGEX REPLACE "^.*[<\"]([^>\"]+)[>\"].*$" "\\1" header "${line}")
  string(FIND "${output}" "${file}: includes ${header}, " place)
  string(FIND "${output}" "${file}: includes ${header} by " place2)
  if(place EQUAL -1 AND place2 EQUAL -1)
    set(${result} OFF PARENT_SCOPE)
  else()
    set(${result} ON PARENT_SCOPE)
  endif()
endfunction()

set(expected 0)
expect_wrong_lines(${ROOT})
if(expected EQUAL 0)
  message(SEND_ERROR "no line is marked under ${ROOT}")
endif()
expect_no_other(": includes ")
