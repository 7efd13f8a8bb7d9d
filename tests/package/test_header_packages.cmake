# Packages of headers for other machines (cmake/toolchains/header_packages.cmake) are found where their headers are there, and
# only there.
#   cmake -D SOURCE_DIR=... -D BUILD_DIR=... -P test_header_packages.cmake
set(work ${BUILD_DIR}/header-packages)
file(REMOVE_RECURSE ${work})
file(WRITE ${work}/CMakeLists.txt [[
cmake_minimum_required(VERSION 3.20)
project(packages NONE)
set(CMAKE_FIND_PACKAGE_PREFER_CONFIG ON)
foreach(package CLI11 Eigen3 fmt nanoflann nlohmann_json)
  set(${package}_DIR ${SOURCE_DIR}/cmake/toolchains/header_packages CACHE PATH "")
  find_package(${package} QUIET)
  message(STATUS "${package} ${${package}_FOUND}")
  if(NOT ${package}_FOUND STREQUAL EXPECTED)
    message(FATAL_ERROR "${package}: ${${package}_FOUND} in ${MEDIAL_VK_TARGET_HEADERS}")
  endif()
endforeach()
]])
file(MAKE_DIRECTORY ${work}/none)
foreach(header CLI/CLI.hpp fmt/format.h nanoflann.hpp nlohmann/json.hpp eigen3/Eigen/Core)
  file(WRITE ${work}/all/${header} "")
endforeach()
file(WRITE ${work}/all/eigen3/Eigen/src/Core/util/Macros.h
  "#define EIGEN_WORLD_VERSION 3\n#define EIGEN_MAJOR_VERSION 4\n#define EIGEN_MINOR_VERSION 0\n")
foreach(case "none;0" "all;1")
  list(GET case 0 folder)
  list(GET case 1 expected)
  execute_process(COMMAND ${CMAKE_COMMAND} -S ${work} -B ${work}/build-${folder} -DSOURCE_DIR=${SOURCE_DIR}
      -DMEDIAL_VK_TARGET_HEADERS=${work}/${folder} -DEXPECTED=${expected}
    OUTPUT_VARIABLE said ERROR_VARIABLE error RESULT_VARIABLE code)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${folder}: ${said}\n${error}")
  endif()
endforeach()
