# For toolchains: libraries that are headers alone, as Debian installs them for its own machines. They are the same for every
# machine, but lie in /usr/include between those of glibc. A folder of links to them is searched by the compiler, and
# find_package() finds each by a file in header_packages/, since Debian's own files name /usr/include.
set(MEDIAL_VK_TARGET_HEADERS ${CMAKE_BINARY_DIR}/target_headers)
file(MAKE_DIRECTORY ${MEDIAL_VK_TARGET_HEADERS})
foreach(name boost CLI eigen3 fmt nanoflann.hpp nlohmann stb vk_video volk.c volk.h vulkan)
  if(EXISTS /usr/include/${name} AND NOT EXISTS ${MEDIAL_VK_TARGET_HEADERS}/${name})
    file(CREATE_LINK /usr/include/${name} ${MEDIAL_VK_TARGET_HEADERS}/${name} SYMBOLIC)
  endif()
endforeach()
set(CMAKE_C_STANDARD_INCLUDE_DIRECTORIES ${MEDIAL_VK_TARGET_HEADERS})
set(CMAKE_CXX_STANDARD_INCLUDE_DIRECTORIES ${MEDIAL_VK_TARGET_HEADERS})
set(VOLK_INCLUDE_DIR ${MEDIAL_VK_TARGET_HEADERS} CACHE PATH "Folder of volk.h")
foreach(package CLI11 Eigen3 fmt nanoflann nlohmann_json)
  set(${package}_DIR ${CMAKE_CURRENT_LIST_DIR}/header_packages CACHE PATH "Found by cmake/toolchains" FORCE)
endforeach()
