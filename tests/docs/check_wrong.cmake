# cmake -DDOXYGEN=… -DROOT=… -DOUTPUT=… -DLAYERS=<headers with mistakes> -P check_wrong.cmake
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/../wrong_lines.cmake)
if(NOT DOXYGEN)
  message(STATUS "skipped: no doxygen")
  return()
endif()
expect_failure("headers with mistakes" ${CMAKE_COMMAND} -DDOXYGEN=${DOXYGEN} -DROOT=${ROOT} -DOUTPUT=${OUTPUT}
               -DLAYERS=${LAYERS} -P ${ROOT}/docs/doxygen.cmake)
string(FIND "${output}" "Value bare of an enumeration of dsc is not documented" place)
if(place EQUAL -1)
  message(SEND_ERROR "not reported: the value of an enumeration")
endif()

function(is_reported file number line result)
  string(FIND "${output}" "${file}:${number}: " place)
  if(place EQUAL -1)
    set(${result} OFF PARENT_SCOPE)
  else()
    set(${result} ON PARENT_SCOPE)
  endif()
endfunction()

set(expected 1)  # the one above
expect_wrong_lines(${LAYERS})
if(expected EQUAL 1)
  message(SEND_ERROR "no line is marked under ${LAYERS}")
endif()
expect_no_other("is not documented")
