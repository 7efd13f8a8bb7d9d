# Renames volk's symbols in a target: medial_vk_prefix_volk(TARGET).
#
# volk defines one global variable for each Vulkan function, under the function's own name. In a static library these
# clash with a host program's own volk, and worse, a host that links the Vulkan loader would call a variable. A header
# that is included before everything else gives every one of them the prefix medial_vk_.
find_path(VOLK_INCLUDE_DIR volk.h REQUIRED)

# Once for all targets: there are thousands of names.
function(_medial_vk_write_volk_prefix header)
  file(STRINGS ${VOLK_INCLUDE_DIR}/volk.h declarations REGEX "^extern PFN_vk|volk[A-Z][A-Za-z]*\\(.*\\);")
  set(names)
  foreach(declaration IN LISTS declarations)
    string(REGEX MATCH "(vk|volk)[A-Z][A-Za-z0-9]*( *;|\\()" name "${declaration}")
    string(REGEX REPLACE "[ ;(]" "" name "${name}")
    list(APPEND names ${name})
  endforeach()
  list(REMOVE_DUPLICATES names)
  list(LENGTH names count)
  if(count LESS 100)
    message(FATAL_ERROR "Only ${count} names found in ${VOLK_INCLUDE_DIR}/volk.h: has its layout changed?")
  endif()
  list(TRANSFORM names REPLACE "(.+)" "#define \\1 medial_vk_\\1\n")
  string(JOIN "" text ${names})
  file(CONFIGURE OUTPUT ${header} CONTENT "/* Made by cmake/PrefixVolk.cmake. */\n${text}" @ONLY)
endfunction()

_medial_vk_write_volk_prefix(${PROJECT_BINARY_DIR}/prefix_volk.h)

function(medial_vk_prefix_volk target)
  target_compile_options(${target} PRIVATE "SHELL:-include \"${PROJECT_BINARY_DIR}/prefix_volk.h\"")
endfunction()
