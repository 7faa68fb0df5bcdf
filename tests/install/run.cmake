# Installs BUILD into a fresh prefix, then configures, builds and runs the project SOURCE against it.
cmake_minimum_required(VERSION 3.25)

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix --config ${CONFIG})
run(${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK}/build -G ${GENERATOR}
  -DCMAKE_PREFIX_PATH=${WORK}/prefix -DCMAKE_BUILD_TYPE=${CONFIG}
  -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_FLAGS=${FLAGS} -DWITH_CHOLMOD=${CHOLMOD}
  -DWITH_TRUTH=${TRUTH} -DWITH_PICTURES=${PICTURES})
run(${CMAKE_COMMAND} --build ${WORK}/build --config ${CONFIG})
run(${WORK}/build/consumer)

# The installed program finds its reader of images, wherever the tree was installed.
if(PROGRAM AND ITK)
  file(WRITE ${WORK}/v.mha "ObjectType = Image\nNDims = 3\nBinaryData = True\nDimSize = 2 2 2\n"
    "ElementSpacing = 1 1 2\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n12345678")
  run(${WORK}/prefix/${PROGRAM} info ${WORK}/v.mha)
endif()
if(VDB AND NOT EXISTS ${WORK}/prefix/${VDB})
  message(FATAL_ERROR "${VDB} was not installed")
endif()

# pkg-config tells a build without CMake the same.
find_program(pkg_config pkg-config)
if(pkg_config)
  file(GLOB_RECURSE pc ${WORK}/prefix/*/libdsc.pc)
  cmake_path(GET pc PARENT_PATH folder)
  set(ENV{PKG_CONFIG_PATH} ${folder})
  execute_process(COMMAND ${pkg_config} --cflags --libs libdsc OUTPUT_VARIABLE flags
    OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  separate_arguments(flags UNIX_COMMAND "${flags}")
  separate_arguments(own UNIX_COMMAND "${FLAGS}")
  run(${COMPILER} ${own} -std=c++20 ${SOURCE}/main.cpp -o ${WORK}/by_pkg_config ${flags}
    -Wl,-rpath,${WORK}/prefix/lib)
  run(${WORK}/by_pkg_config)
else()
  message(STATUS "skipped: there is no pkg-config")
endif()

# The manual page and the completions of shells are there.
if(PROGRAM)
  foreach(text man/man1/dsc.1 bash-completion/completions/dsc zsh/vendor-completions/_dsc)
    if(NOT EXISTS ${WORK}/prefix/share/${text})
      message(FATAL_ERROR "share/${text} was not installed")
    endif()
  endforeach()
endif()
