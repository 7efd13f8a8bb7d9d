# Debian's cross compiler for 64-bit ARM (g++-aarch64-linux-gnu), with headers and libraries from the folder that
# scripts/make-arm64-root makes. What is built runs under qemu-user (scripts/arm64-run, docs/testing.md).
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)

set(MEDIAL_VK_ARM64_ROOT ${CMAKE_CURRENT_LIST_DIR}/../../build/arm64-root CACHE PATH
  "Headers and libraries for arm64 (scripts/make-arm64-root)")
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES MEDIAL_VK_ARM64_ROOT)
cmake_path(ABSOLUTE_PATH MEDIAL_VK_ARM64_ROOT NORMALIZE OUTPUT_VARIABLE CMAKE_SYSROOT)
if(NOT EXISTS ${CMAKE_SYSROOT}/usr/include)
  message(FATAL_ERROR "There are no headers for arm64 in ${CMAKE_SYSROOT}: run scripts/make-arm64-root")
endif()
# Programs that build are those of this machine.
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(ENV{PKG_CONFIG_SYSROOT_DIR} ${CMAKE_SYSROOT})
set(ENV{PKG_CONFIG_LIBDIR} ${CMAKE_SYSROOT}/usr/lib/aarch64-linux-gnu/pkgconfig:${CMAKE_SYSROOT}/usr/share/pkgconfig)

# CMake reads from what the compiler prints where it looks for headers; with relative paths it would not know them again.
set(ENV{CCACHE_BASEDIR} "")

# The build starts its tests to list their names.
find_program(MEDIAL_VK_QEMU_AARCH64 NAMES qemu-aarch64 qemu-aarch64-static)
if(MEDIAL_VK_QEMU_AARCH64)
  set(CMAKE_CROSSCOMPILING_EMULATOR ${MEDIAL_VK_QEMU_AARCH64} -L ${CMAKE_SYSROOT})
endif()
