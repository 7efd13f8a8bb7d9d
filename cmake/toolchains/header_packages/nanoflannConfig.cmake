# nanoflann from MEDIAL_VK_TARGET_HEADERS (../header_packages.cmake).
if(NOT TARGET nanoflann::nanoflann)
  add_library(nanoflann::nanoflann INTERFACE IMPORTED)
endif()
set(nanoflann_FOUND TRUE)
