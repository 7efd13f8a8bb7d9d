# The version of the headers, as Eigen/src/Core/util/Macros.h gives it.
set(PACKAGE_VERSION_COMPATIBLE TRUE)
if(NOT EXISTS ${MEDIAL_VK_TARGET_HEADERS}/eigen3/Eigen/Core)
  return()  # Eigen3Config.cmake says that it is missing
endif()
file(STRINGS ${MEDIAL_VK_TARGET_HEADERS}/eigen3/Eigen/src/Core/util/Macros.h lines REGEX "#define EIGEN_(WORLD|MAJOR|MINOR)_VERSION")
string(REGEX MATCHALL "[0-9]+" numbers "${lines}")
list(JOIN numbers "." PACKAGE_VERSION)
if(PACKAGE_VERSION VERSION_LESS PACKAGE_FIND_VERSION)
  set(PACKAGE_VERSION_COMPATIBLE FALSE)
endif()
