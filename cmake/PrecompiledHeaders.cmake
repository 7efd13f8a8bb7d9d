# Headers that many sources include are compiled once for all targets with the same flags.
#   medial_vk_precompile_headers(HOLDER HEADER ...)          HOLDER is a new object library
#   medial_vk_use_precompiled_headers(TARGET HOLDER)
# A holder is a target of its own, so that no target waits for the sources of another one. TARGET must have the language
# options, the optimisation and the position independence of HOLDER, whose properties the caller may set.
if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  # CMake's own options give the paths behind -Xclang, where ccache does not make them relative to its base folder. With
  # -include PATH clang takes PATH.pch.
  set(CMAKE_CXX_COMPILE_OPTIONS_USE_PCH -include <PCH_HEADER>)
endif()

function(medial_vk_precompile_headers holder)
  file(CONFIGURE OUTPUT ${holder}.cpp CONTENT "// Made by cmake/PrecompiledHeaders.cmake: holds precompiled headers.\n")
  add_library(${holder} OBJECT ${CMAKE_CURRENT_BINARY_DIR}/${holder}.cpp)
  set_target_properties(${holder} PROPERTIES UNITY_BUILD OFF)
  target_include_directories(${holder} PRIVATE ${PROJECT_BINARY_DIR})
  if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    target_compile_options(${holder} PRIVATE "SHELL:-Xclang -fno-pch-timestamp")  # for ccache
  endif()
  medial_vk_project_options(${holder})
  if(CMAKE_CXX_COMPILER_LAUNCHER MATCHES "ccache")
    set_target_properties(${holder} PROPERTIES CXX_COMPILER_LAUNCHER
      "${CMAKE_COMMAND};-P;${PROJECT_SOURCE_DIR}/cmake/PrecompileWithDigest.cmake;--;${CMAKE_CXX_COMPILER_LAUNCHER}")
  endif()
  target_precompile_headers(${holder} PRIVATE ${ARGN})
endfunction()

function(medial_vk_use_precompiled_headers target holder)
  target_precompile_headers(${target} REUSE_FROM ${holder})
  # ccache preprocesses with the headers that clang has compiled, those of the build folder among them.
  target_include_directories(${target} PRIVATE ${PROJECT_BINARY_DIR})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -fpch-preprocess)  # for ccache
    if(CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13 AND NOT CMAKE_DISABLE_PRECOMPILE_HEADERS)
      # False alarms in std::string (GCC bug 105651), which in a precompiled header are no longer in a system header.
      target_compile_options(${target} PRIVATE -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread)
    endif()
  endif()
endfunction()
