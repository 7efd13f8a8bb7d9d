# Warnings and sanitizers for every target of the project: medial_vk_project_options(TARGET).
find_package(Threads REQUIRED)

function(medial_vk_project_options target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
    $<$<COMPILE_LANGUAGE:CXX>:-Wnon-virtual-dtor>)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    target_compile_options(${target} PRIVATE -Wno-restrict)  # false alarms in std::string: GCC bug 105651
  endif()
  if(CMAKE_SYSTEM_PROCESSOR STREQUAL "aarch64" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -Wno-psabi)  # notes on how GCC 9 passed a std::pair of doubles
  endif()
  if(CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # Sources that are compiled together count as included, and gcc wants no local type in a class of an included file.
    target_compile_options(${target} PRIVATE $<$<COMPILE_LANGUAGE:CXX>:-Wno-subobject-linkage>)
  endif()
  if(MEDIAL_VK_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  # The certificate relies on IEEE arithmetic as written: no contraction into fused operations, no reordering. Eigen calls
  # fused operations itself where these macros say that the processor has them.
  target_compile_options(${target} PRIVATE -ffp-contract=off)
  if(CMAKE_SYSTEM_PROCESSOR STREQUAL "aarch64")
    target_compile_options(${target} PRIVATE -U__ARM_FEATURE_FMA)
  elseif(CMAKE_CXX_FLAGS MATCHES "-m(arch|fma|avx|cpu)")
    target_compile_options(${target} PRIVATE -U__FMA__)
  endif()
  # No code reads errno after a function of <cmath>; square roots without it are computed several at a time.
  target_compile_options(${target} PRIVATE -fno-math-errno)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND NOT target STREQUAL "medial_vk_reference")
    # gcc 12.2 leaves out the rounding in double -> float -> double where it computes two of them at a time. The
    # reference has no float, and is a third faster with that optimisation.
    target_compile_options(${target} PRIVATE -fno-tree-slp-vectorize)
  endif()
  if(MINGW AND CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64")
    # The stack of Windows is aligned to 16 bytes, and gcc spills vectors of 32 bytes as if it were to 32 (GCC bug 54412):
    # the assembler writes every such move as one that needs no alignment.
    target_compile_options(${target} PRIVATE -Wa,-muse-unaligned-vector-move)
    # Objects with a section for each of very many inline functions.
    target_compile_options(${target} PRIVATE -Wa,-mbig-obj)
  endif()
  if(MEDIAL_VK_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=address,undefined -fno-sanitize-recover=undefined
      -fno-omit-frame-pointer)
    target_compile_definitions(${target} PRIVATE MEDIAL_VK_SANITIZED)  # for tests that limit memory
    target_link_options(${target} PUBLIC -fsanitize=address,undefined)
    get_target_property(type ${target} TYPE)
    if(type STREQUAL "EXECUTABLE")
      # A separate object: a program with a C source could not use precompiled headers of another target.
      if(NOT TARGET medial_vk_keep_libraries)
        add_library(medial_vk_keep_libraries OBJECT ${PROJECT_SOURCE_DIR}/cmake/keep_libraries.c)
      endif()
      target_link_libraries(${target} PRIVATE medial_vk_keep_libraries)
      target_link_options(${target} PRIVATE -Wl,--export-dynamic-symbol=dlclose)
    endif()
  endif()
  if(MEDIAL_VK_SANITIZE_THREADS)
    # volk.c too: threads could race for its global pointers.
    target_compile_options(${target} PRIVATE -fsanitize=thread -fno-omit-frame-pointer)
    target_compile_definitions(${target} PRIVATE MEDIAL_VK_SANITIZED)
    target_link_options(${target} PUBLIC -fsanitize=thread)
  endif()
endfunction()
