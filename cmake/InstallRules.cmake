# The destinations of `cmake --install`: the library with its headers, CMake package and pkg-config file, the tool, the
# manual and the licence. Everything can be moved after installation: no file holds an absolute path.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/medial_vk)

set(libraries medial_vk)
if(TARGET medial_vk_dll)
  list(APPEND libraries medial_vk_dll)
endif()
install(TARGETS ${libraries} EXPORT medial_vk-targets
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR}
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/runtime/include/medial_vk DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  FILES_MATCHING PATTERN "*.h")

# find_package(medial_vk) -> medial_vk::medial_vk
install(EXPORT medial_vk-targets NAMESPACE medial_vk:: DESTINATION ${package_dir})
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/medial_vk-config.cmake.in
  ${PROJECT_BINARY_DIR}/medial_vk-config.cmake INSTALL_DESTINATION ${package_dir})
# Before 1.0 the interface may change with the minor version.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/medial_vk-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/medial_vk-config.cmake ${PROJECT_BINARY_DIR}/medial_vk-config-version.cmake
  DESTINATION ${package_dir})

# pkg-config: the prefix is derived from the location of the file.
file(RELATIVE_PATH pc_to_prefix ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
file(RELATIVE_PATH pc_libdir ${CMAKE_INSTALL_PREFIX} ${CMAKE_INSTALL_FULL_LIBDIR})
file(RELATIVE_PATH pc_includedir ${CMAKE_INSTALL_PREFIX} ${CMAKE_INSTALL_FULL_INCLUDEDIR})
configure_file(${PROJECT_SOURCE_DIR}/cmake/medial_vk.pc.in ${PROJECT_BINARY_DIR}/medial_vk.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/medial_vk.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

if(TARGET medial-vk)
  install(TARGETS medial-vk RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  install(TARGETS medial-vk-read-scene RUNTIME DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/medial-vk)
  install(FILES ${PROJECT_SOURCE_DIR}/docs/medial-vk.1 ${PROJECT_SOURCE_DIR}/docs/medial-vk-batch.1
    ${PROJECT_SOURCE_DIR}/docs/medial-vk-spheres.1 ${PROJECT_SOURCE_DIR}/docs/medial-vk-fit.1
    ${PROJECT_SOURCE_DIR}/docs/medial-vk-clearance.1 ${PROJECT_SOURCE_DIR}/docs/medial-vk-curvature.1
    ${PROJECT_SOURCE_DIR}/docs/medial-vk-distance.1
    ${PROJECT_SOURCE_DIR}/docs/medial-vk-doctor.1 ${PROJECT_SOURCE_DIR}/docs/medial-vk-follow.1
    ${PROJECT_SOURCE_DIR}/docs/medial-vk-plane.1 ${PROJECT_SOURCE_DIR}/docs/medial-vk-voronoi.1
    DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
  # The workflow for clusters, whose scripts are run from there.
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/workflows DESTINATION ${CMAKE_INSTALL_DATADIR}/medial-vk USE_SOURCE_PERMISSIONS
    PATTERN __pycache__ EXCLUDE)
endif()
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(CODE "set(SOURCE_DIR \"${PROJECT_SOURCE_DIR}\")
  set(WORK_DIR \"${PROJECT_BINARY_DIR}/user_documents\")
  set(DESTINATION \"${CMAKE_INSTALL_DOCDIR}\")")
install(SCRIPT ${PROJECT_SOURCE_DIR}/cmake/InstallUserDocuments.cmake)
