# Installs the build into an empty folder, moves it, and builds and runs programs of users against it: by
# find_package, with a Vulkan of their own, and by pkg-config.
# Needs: BUILD_DIR SOURCE_DIR CONFIG GENERATOR CXX_COMPILER CXX_FLAGS NM VERSION
cmake_minimum_required(VERSION 3.25)

set(work ${BUILD_DIR}/package-test)
set(prefix ${work}/prefix)
file(REMOVE_RECURSE ${work})

include(${CMAKE_CURRENT_LIST_DIR}/run_programs.cmake)

# A program with a Vulkan device of its own; or no device.
function(run_host what program)
  execute_process(COMMAND ${program} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE errors)
  if(errors MATCHES "no Vulkan device")
    message("SKIPPED: running ${what}, there is no Vulkan device")
  elseif(NOT result EQUAL 0 OR NOT output MATCHES "[1-9][0-9]* medial spheres of a box")
    message(FATAL_ERROR "${what}: exit status ${result}\n${output}${errors}")
  endif()
endfunction()

# check_for_users(FILE TEXT): fails if TEXT, of FILE, names files of the source tree that only contributors need. The
# commands that build the source tree, in README.md, are for its users, too.
function(check_for_users file text)
  if(file MATCHES "/README\\.md$")
    string(REGEX REPLACE "\n## Two commands\n(#?[^#]|##[#]*[^# ])*\n## " "\n## " text "${text}")
  endif()
  if(text MATCHES "\\.ci/|scripts/lint|scripts/test|scripts/check-rooms|cmake/rooms|tests/|bench/")
    message(FATAL_ERROR "${file} names ${CMAKE_MATCH_0}, which is not installed")
  endif()
endfunction()

run("install" ${CMAKE_COMMAND} --install ${BUILD_DIR} --config ${CONFIG} --prefix ${work}/first)
file(RENAME ${work}/first ${prefix})  # nothing in it may depend on where it was installed
foreach(file bin/medial-vk share/medial-vk/workflows/Snakefile libexec/medial-vk/medial-vk-read-scene include/medial_vk/context.h
    include/medial_vk/extraction.h include/medial_vk/result.h)
  if(NOT EXISTS ${prefix}/${file})
    message(FATAL_ERROR "not installed: ${file}")
  endif()
endforeach()
foreach(pattern libmedial_vk.a medial_vk.pc medial_vk-config.cmake medial_vk-config-version.cmake LICENSE README.md)
  file(GLOB_RECURSE ${pattern} ${prefix}/*/${pattern})
  if(NOT ${pattern})
    message(FATAL_ERROR "not installed: ${pattern}")
  endif()
endforeach()
# Links of installed documents lead to files that are installed, too.
file(GLOB_RECURSE documents ${prefix}/*.md)
list(LENGTH documents count)
if(count LESS 10)
  message(FATAL_ERROR "only ${count} documents are installed")
endif()
foreach(file IN LISTS documents)
  file(READ ${file} text)
  get_filename_component(folder ${file} DIRECTORY)
  check_for_users(${file} "${text}")
  string(REPLACE "](" "<link>" text "${text}")  # brackets would join elements of the list
  string(REGEX MATCHALL "<link>[^]);#:]+[)#]" links "${text}")
  foreach(link IN LISTS links)
    string(REGEX REPLACE "^<link>(.*).$" "\\1" link "${link}")
    if(NOT EXISTS ${folder}/${link})
      message(FATAL_ERROR "${file} links to ${link}, which is not installed")
    endif()
  endforeach()
endforeach()
file(GLOB_RECURSE installed_text ${prefix}/*.cmake ${prefix}/*.pc ${prefix}/*.h ${prefix}/*.1)
foreach(file IN LISTS installed_text)
  file(READ ${file} text)
  check_for_users(${file} "${text}")
  foreach(folder ${SOURCE_DIR} ${BUILD_DIR})
    string(FIND "${text}" "${folder}" position)
    if(NOT position EQUAL -1)
      message(FATAL_ERROR "${file} names the folder ${folder}, which its users do not have")
    endif()
  endforeach()
endforeach()

run("medial-vk --version" ${prefix}/bin/medial-vk --version)
if(NOT output MATCHES "${VERSION}")
  message(FATAL_ERROR "medial-vk --version does not print ${VERSION}: ${output}")
endif()

# The moved tool finds the program that reads scenes: it answers, that it reads the file or that it was built without
# assimp.
file(WRITE ${work}/triangle.gltf "{\"asset\":{\"version\":\"2.0\"}}")
execute_process(COMMAND ${prefix}/bin/medial-vk ${work}/triangle.gltf --backend cpu ERROR_VARIABLE errors
  RESULT_VARIABLE result)
if(NOT result EQUAL 3 OR NOT errors MATCHES "no faces|assimp cannot read|this build reads no")
  message(FATAL_ERROR "medial-vk does not read a scene after installation: exit status ${result}\n${errors}")
endif()

# No symbol of Vulkan or volk may leak out of the library.
run("symbols" ${NM} --extern-only --defined-only ${libmedial_vk.a})
string(REGEX MATCHALL "[0-9a-f]+ [A-Z] (vk|volk)[A-Z][A-Za-z0-9]*" leaked "${output}")
if(leaked)
  list(LENGTH leaked count)
  list(GET leaked 0 first)
  message(FATAL_ERROR "libmedial_vk.a defines ${count} symbols of Vulkan or volk, the first: ${first}")
endif()

run("consumer: configure" ${CMAKE_COMMAND} -S ${SOURCE_DIR}/tests/package/consumer -B ${work}/consumer -G ${GENERATOR}
  -DCMAKE_BUILD_TYPE=${CONFIG} -DCMAKE_CXX_COMPILER=${CXX_COMPILER} -DCMAKE_CXX_FLAGS=${CXX_FLAGS}
  -DCMAKE_PREFIX_PATH=${prefix} -DVERSION=${VERSION} -DEXAMPLES_DIR=${SOURCE_DIR}/examples)
run("consumer: build" ${CMAKE_COMMAND} --build ${work}/consumer --config ${CONFIG} --parallel 2)
run("consumer: with the loader" ${work}/consumer/loader_host)
run("consumer: with its own volk" ${work}/consumer/volk_host)
run_embed("find_package" ${work}/consumer/embed)
run_host("find_package" ${work}/consumer/minimal_host)

# pkg-config
get_filename_component(pc_folder ${medial_vk.pc} DIRECTORY)
set(ENV{PKG_CONFIG_PATH} ${pc_folder})
run("pkg-config" pkg-config --cflags --libs "medial_vk = ${VERSION}")
separate_arguments(flags UNIX_COMMAND "${output}")
separate_arguments(cxx_flags UNIX_COMMAND "${CXX_FLAGS}")
run("pkg-config: build" ${CXX_COMPILER} -std=c++20 ${cxx_flags} ${SOURCE_DIR}/examples/embed.cpp ${flags}
  -o ${work}/embed_pkg_config)
run_embed("pkg-config" ${work}/embed_pkg_config)
run("pkg-config: build a host" ${CXX_COMPILER} -std=c++20 ${cxx_flags} ${SOURCE_DIR}/examples/minimal_host.cpp ${flags}
  -lvulkan -o ${work}/minimal_host_pkg_config)
run_host("pkg-config" ${work}/minimal_host_pkg_config)

file(REMOVE_RECURSE ${work})
