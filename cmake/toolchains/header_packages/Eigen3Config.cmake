# Eigen3 from MEDIAL_VK_TARGET_HEADERS (../header_packages.cmake).
if(NOT TARGET Eigen3::Eigen)
  add_library(Eigen3::Eigen INTERFACE IMPORTED)
  target_include_directories(Eigen3::Eigen SYSTEM INTERFACE ${MEDIAL_VK_TARGET_HEADERS}/eigen3)
endif()
set(Eigen3_FOUND TRUE)
