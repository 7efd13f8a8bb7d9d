# Windows on x86-64, by Debian's MinGW-w64 with POSIX threads (g++-mingw-w64-x86-64-posix): the preset `windows`, and
# docs/windows.md.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(medial_vk_target x86_64-w64-mingw32)
set(CMAKE_C_COMPILER ${medial_vk_target}-gcc-posix)
set(CMAKE_CXX_COMPILER ${medial_vk_target}-g++-posix)
set(CMAKE_RC_COMPILER ${medial_vk_target}-windres)

# Programs run here; libraries are those of MinGW-w64 alone, so that nothing of Debian's own gets into a build.
set(CMAKE_FIND_ROOT_PATH /usr/${medial_vk_target})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
if(NOT DEFINED ENV{PKG_CONFIG_LIBDIR})
  set(ENV{PKG_CONFIG_LIBDIR} /usr/${medial_vk_target}/lib/pkgconfig)
endif()

include(${CMAKE_CURRENT_LIST_DIR}/header_packages.cmake)

# The runtime libraries of GCC are linked in, so that programs and the DLL need those of Windows alone.
# No time stamps: the same sources give the same bytes.
set(CMAKE_EXE_LINKER_FLAGS_INIT "-static -Wl,--no-insert-timestamp")
set(CMAKE_SHARED_LINKER_FLAGS_INIT "-static -Wl,--no-insert-timestamp")
