# fmt from MEDIAL_VK_TARGET_HEADERS (../header_packages.cmake), whose compiled library is for Debian's own machines.
if(NOT TARGET fmt::fmt)
  add_library(fmt::fmt-header-only INTERFACE IMPORTED)
  target_compile_definitions(fmt::fmt-header-only INTERFACE FMT_HEADER_ONLY=1)
  add_library(fmt::fmt INTERFACE IMPORTED)
  target_link_libraries(fmt::fmt INTERFACE fmt::fmt-header-only)
endif()
set(fmt_FOUND TRUE)
