# Builds and runs a program of a user that has this source tree inside its own (add_subdirectory).
# Needs: BUILD_DIR SOURCE_DIR GENERATOR CXX_COMPILER CXX_FLAGS
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/run_programs.cmake)

set(work ${BUILD_DIR}/source-tree-test)
file(REMOVE_RECURSE ${work})
# Compiled without optimisation and in few units, which takes a third of the time: the test concerns how
# the two projects fit together, and the extraction of a box takes no longer.
run("embedded: configure" ${CMAKE_COMMAND} -S ${SOURCE_DIR}/tests/package/embedded -B ${work}/embedded -G ${GENERATOR}
  -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_COMPILER=${CXX_COMPILER} -DCMAKE_CXX_FLAGS=${CXX_FLAGS}
  -DCMAKE_CXX_FLAGS_DEBUG=-O0 -DCMAKE_C_FLAGS_DEBUG=-O0 -DCMAKE_UNITY_BUILD=ON -DMEDIAL_VK_DIR=${SOURCE_DIR})
run("embedded: build" ${CMAKE_COMMAND} --build ${work}/embedded --config Debug --parallel 2 --target embed)
run_embed("add_subdirectory" ${work}/embedded/embed)

file(REMOVE_RECURSE ${work})
