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
  -DWITH_TRUTH=${TRUTH})
run(${CMAKE_COMMAND} --build ${WORK}/build --config ${CONFIG})
run(${WORK}/build/consumer)

# The installed program finds its reader of images, wherever the tree was installed.
if(PROGRAM AND ITK)
  file(WRITE ${WORK}/v.mha "ObjectType = Image\nNDims = 3\nBinaryData = True\nDimSize = 2 2 2\n"
    "ElementSpacing = 1 1 2\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n12345678")
  run(${WORK}/prefix/${PROGRAM} info ${WORK}/v.mha)
endif()
