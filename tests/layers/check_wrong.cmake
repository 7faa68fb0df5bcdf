# cmake -DCHECK=<check_layers.cmake> -DROOT=<a tree with mistakes> -P check_wrong.cmake
#
# The check is only worth something if it fails: every include in the tree marked `// wrong` has to
# be reported, and no other.
cmake_minimum_required(VERSION 3.25)
execute_process(COMMAND ${CMAKE_COMMAND} -DROOT=${ROOT} -P ${CHECK}
  RESULT_VARIABLE result ERROR_VARIABLE output OUTPUT_VARIABLE output)
if(result EQUAL 0)
  message(FATAL_ERROR "the check passed a tree with mistakes")
endif()
# CMake breaks long lines of its messages; undo that.
string(REGEX REPLACE "[ \n]+" " " output "${output}")

set(expected 0)
file(GLOB_RECURSE files RELATIVE ${ROOT} ${ROOT}/*)
foreach(file IN LISTS files)
  file(STRINGS ${ROOT}/${file} lines REGEX "// wrong$")
  foreach(line IN LISTS lines)
    math(EXPR expected "${expected} + 1")
    string(REGEX REPLACE "^.*[<\"]([^>\"]+)[>\"].*$" "\\1" header "${line}")
    string(FIND "${output}" "${file}: includes ${header}, " place)
    string(FIND "${output}" "${file}: includes ${header} by " place2)
    if(place EQUAL -1 AND place2 EQUAL -1)
      message(SEND_ERROR "not reported: ${file}: ${line}")
    endif()
  endforeach()
endforeach()
string(REGEX MATCHALL ": includes " reports "${output}")
list(LENGTH reports reported)
if(NOT reported EQUAL expected OR expected EQUAL 0)
  message(SEND_ERROR "${reported} reports for ${expected} mistakes: ${output}")
endif()
