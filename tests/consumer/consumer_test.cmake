# Installs the build into a temporary prefix, then configures, builds and runs a consumer against it, together with the
# library example of the README.
# Usage: cmake -D SOURCE_DIR=... -D BUILD_DIR=... -D SCRATCH_DIR=... -D CXX=... [-D CXX_FLAGS=...] [-D WITH_DICOM=ON] -P consumer_test.cmake
function(run)
  execute_process(COMMAND ${ARGV} WORKING_DIRECTORY ${SCRATCH_DIR} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE ${SCRATCH_DIR})
file(MAKE_DIRECTORY ${SCRATCH_DIR})
run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${SCRATCH_DIR}/prefix)

file(READ ${SOURCE_DIR}/README.md readme)
if(NOT readme MATCHES "\n```cpp\n([^`]+)```")
  message(FATAL_ERROR "README.md has no C++ example")
endif()
file(WRITE ${SCRATCH_DIR}/readme_example.cpp "${CMAKE_MATCH_1}")

run(${CMAKE_COMMAND} -G Ninja -S ${SOURCE_DIR}/tests/consumer -B ${SCRATCH_DIR}/build
  -D CMAKE_PREFIX_PATH=${SCRATCH_DIR}/prefix -D README_EXAMPLE=${SCRATCH_DIR}/readme_example.cpp
  -D CMAKE_CXX_COMPILER=${CXX} "-DCMAKE_CXX_FLAGS=${CXX_FLAGS}")
run(${CMAKE_COMMAND} --build ${SCRATCH_DIR}/build)
run(${SCRATCH_DIR}/build/consumer)
run(${SCRATCH_DIR}/build/readme_example)
run(${SCRATCH_DIR}/prefix/bin/pdc --version)
if(WITH_DICOM)
  string(REPEAT "-" 128 preamble)
  file(WRITE ${SCRATCH_DIR}/damaged.dcm "${preamble}DICM-")
  execute_process(COMMAND ${SCRATCH_DIR}/prefix/bin/pdc info ${SCRATCH_DIR}/damaged.dcm ERROR_VARIABLE line)
  if(NOT line MATCHES "damaged.dcm" OR line MATCHES "is not read")
    message(FATAL_ERROR "the installed program has no module for DICOM: ${line}")
  endif()
endif()
file(REMOVE_RECURSE ${SCRATCH_DIR})
