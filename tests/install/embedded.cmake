# Configures the project SOURCE, which takes libdsc in, both ways; builds and runs it one way. The layers
# up to calculus are enough to see that it works.
cmake_minimum_required(VERSION 3.25)

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE ${WORK})
foreach(fetch OFF ON)
  run(${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK}/${fetch} -G ${GENERATOR} -DLIBDSC=${LIBDSC} -DFETCH=${fetch}
    -DDSC_CORE_ONLY=ON -DCMAKE_BUILD_TYPE=None -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_FLAGS=-O0)
endforeach()
run(${CMAKE_COMMAND} --build ${WORK}/ON --parallel 2)
run(${WORK}/ON/consumer)
