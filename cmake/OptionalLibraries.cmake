# Libraries without which the tool is built without a part, and says so: medial_vk_assimp, medial_vk_zip, medial_vk_xml. Each
# is a target to link, which defines MEDIAL_VK_HAS_ASSIMP, _ZIP or _XML if the library is there. Of the options, AUTO uses
# a library if it is installed.
#   medial_vk_optional_library(TARGET OPTION DEFINITION IMPORTED WITHOUT)   WITHOUT is the message
foreach(row "ASSIMP;glTF, 3MF, FBX, COLLADA and more by assimp" "LIBZIP;.npz by libzip" "TINYXML2;URDF, SRDF and SVG by tinyxml2")
  list(GET row 0 name)
  list(GET row 1 what)
  set(MEDIAL_VK_USE_${name} AUTO CACHE STRING "Read ${what}: ON, OFF or AUTO")
  set_property(CACHE MEDIAL_VK_USE_${name} PROPERTY STRINGS AUTO ON OFF)
endforeach()

if(MEDIAL_VK_USE_ASSIMP STREQUAL "AUTO")
  find_package(assimp QUIET)
elseif(MEDIAL_VK_USE_ASSIMP)
  find_package(assimp REQUIRED)
endif()
# find_package is not used for these, because Debian's files for them require packages that are not needed.
if(MEDIAL_VK_USE_LIBZIP OR MEDIAL_VK_USE_TINYXML2)
  find_package(PkgConfig REQUIRED)
endif()
foreach(library libzip tinyxml2)
  string(TOUPPER ${library} name)
  if(MEDIAL_VK_USE_${name} STREQUAL "AUTO")
    pkg_check_modules(${library} QUIET IMPORTED_TARGET ${library})
  elseif(MEDIAL_VK_USE_${name})
    pkg_check_modules(${library} REQUIRED IMPORTED_TARGET ${library})
  endif()
endforeach()

function(medial_vk_optional_library target option definition imported without)
  add_library(${target} INTERFACE)
  if(${option} AND TARGET ${imported})
    target_link_libraries(${target} INTERFACE ${imported})
    target_compile_definitions(${target} INTERFACE ${definition})
  else()
    message(STATUS "Without ${without}")
  endif()
endfunction()
set(assimp_packages libassimp-dev)
if(MEDIAL_VK_USE_ASSIMP STREQUAL "AUTO" AND NOT TARGET PkgConfig::libzip)
  set(MEDIAL_VK_USE_ASSIMP OFF)  # archives of scenes are measured by libzip before they are expanded
  set(assimp_packages libzip-dev)
  if(NOT TARGET assimp::assimp)
    set(assimp_packages "libassimp-dev libzip-dev")
  endif()
endif()
medial_vk_optional_library(medial_vk_assimp MEDIAL_VK_USE_ASSIMP MEDIAL_VK_HAS_ASSIMP assimp::assimp
  "assimp: OBJ, PLY, STL and OFF are read, glTF, 3MF, FBX and COLLADA are not (${assimp_packages})")
medial_vk_optional_library(medial_vk_zip MEDIAL_VK_USE_LIBZIP MEDIAL_VK_HAS_ZIP PkgConfig::libzip
  "libzip: no .npz is read or written, sets of balls for `distance` among them (libzip-dev)")
medial_vk_optional_library(medial_vk_xml MEDIAL_VK_USE_TINYXML2 MEDIAL_VK_HAS_XML PkgConfig::tinyxml2
  "tinyxml2: no URDF, SRDF or SVG is read, and no URDF is written (libtinyxml2-dev)")
