# Tests in a build for Windows (docs/windows.md): the folders that are built, and sources that are left out of them.
# GoogleTest is compiled from Debian's sources, whose libraries are for its own machines.
set(MEDIAL_VK_TEST_FOLDERS unit gpu_vs_cpu)
add_subdirectory(/usr/src/googletest googletest EXCLUDE_FROM_ALL)
foreach(target gtest gtest_main gmock)
  target_compile_options(${target} PRIVATE -w)
endforeach()

# Calls of POSIX in the tests themselves; tests/cli, faults, picture, ... start processes by them, and scripts/test-windows
# takes their place.
set(posix cli/doctor_child_process cli/doctor_machine cli/doctor_advice cli/doctor_driver_search cli/progress_terminal
    input/read_devices output/doctor_report output/output_atomic_file)
# Parts that a build without libzip, tinyxml2 and assimp lacks.
set(absent ball_files/.* body_files/.* robots/.* rigs/.* scene_files/.* shape_files/.*svg.* output/.*npz.* output/.*urdf.*)
# SPIRV-Tools are not there for the target; trees of measurements.
set(other shaders/.* bench_sphere_peers/.* bench_trees/.* following/golden_motion)
string(JOIN "|" MEDIAL_VK_TESTS_ELSEWHERE ${posix} ${absent} ${other})

function(medial_vk_leave_out_tests list_name)
  set(kept ${${list_name}})
  list(FILTER kept EXCLUDE REGEX "/unit/(${MEDIAL_VK_TESTS_ELSEWHERE})(_test)?[.](cpp|h)$")
  set(${list_name} ${kept} PARENT_SCOPE)
endfunction()
