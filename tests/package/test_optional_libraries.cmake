# What CMake says of optional libraries that are absent (cmake/OptionalLibraries.cmake): which package is missing. Without all
# three, pkg-config is not needed.
#   cmake -D SOURCE_DIR=... -D BUILD_DIR=... -P test_optional_libraries.cmake
set(work ${BUILD_DIR}/optional-libraries)

# assimp, where it is not to be found, is a library without anything. EXPECTED: parts of the output.
function(configure name expected)
  file(REMOVE_RECURSE ${work}/${name})
  file(WRITE ${work}/${name}/CMakeLists.txt "cmake_minimum_required(VERSION 3.20)\nproject(libraries NONE)\n"
    "include(${SOURCE_DIR}/cmake/OptionalLibraries.cmake)\n")
  file(WRITE ${work}/${name}/assimp/assimpConfig.cmake "add_library(assimp::assimp INTERFACE IMPORTED)\n")
  file(MAKE_DIRECTORY ${work}/${name}/pc)
  execute_process(COMMAND ${CMAKE_COMMAND} -E env PKG_CONFIG_LIBDIR=${work}/${name}/pc
    ${CMAKE_COMMAND} -S ${work}/${name} -B ${work}/${name}/build ${ARGN}
    OUTPUT_VARIABLE said ERROR_VARIABLE error RESULT_VARIABLE code)
  string(REGEX REPLACE "[ \n]+" " " said "${said}")
  string(FIND "${said}" "${expected}" at)
  if(NOT code EQUAL 0 OR at EQUAL -1)
    message(FATAL_ERROR "${name}: '${expected}' is not said, exit code ${code}:\n${said}\n${error}")
  endif()
endfunction()

configure(no_libzip "FBX and COLLADA are not (libzip-dev)" -Dassimp_DIR=${work}/no_libzip/assimp)
configure(neither "FBX and COLLADA are not (libassimp-dev libzip-dev)" -DCMAKE_DISABLE_FIND_PACKAGE_assimp=ON)
configure(nothing "FBX and COLLADA are not (libassimp-dev)" -DMEDIAL_VK_USE_ASSIMP=OFF -DMEDIAL_VK_USE_LIBZIP=OFF
  -DMEDIAL_VK_USE_TINYXML2=OFF -DCMAKE_DISABLE_FIND_PACKAGE_PkgConfig=ON)
