# SPDX-License-Identifier: Apache-2.0
# Installs the build into an empty prefix, then builds and runs a project that knows nothing but that prefix.
# usage: cmake -DSOURCE=… -DBUILD=… -DWORK=… -DCOMPILER=… -DGENERATOR=… -DBUILD_TYPE=…
#        -DSANITIZE=… -P install_test.cmake
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGV}\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE "${WORK}")
run("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${WORK}/prefix")

file(GLOB_RECURSE ours RELATIVE "${SOURCE}" "${SOURCE}/beaconless/*.hpp")
file(GLOB_RECURSE installed RELATIVE "${WORK}/prefix/include" "${WORK}/prefix/include/*.hpp")
if(NOT ours STREQUAL installed)
  message(FATAL_ERROR "the headers of the project\n${ours}\nare not those installed\n${installed}")
endif()
list(TRANSFORM installed REPLACE "(.+)" "#include <\\1>\n" OUTPUT_VARIABLE includes)
string(CONCAT every_header ${includes})
file(WRITE "${WORK}/every_header.cpp" "${every_header}")

if(SANITIZE)
  set(sanitize "-DCMAKE_CXX_FLAGS=-fsanitize=${SANITIZE}")
endif()
run("${CMAKE_COMMAND}" -S "${CMAKE_CURRENT_LIST_DIR}/stranger" -B "${WORK}/build" -G "${GENERATOR}"
    "-DCMAKE_PREFIX_PATH=${WORK}/prefix" "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_BUILD_TYPE=${BUILD_TYPE}"
    "-DEVERY_HEADER=${WORK}/every_header.cpp" ${sanitize})
run("${CMAKE_COMMAND}" --build "${WORK}/build")
run("${WORK}/build/stranger")
