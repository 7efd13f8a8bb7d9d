# Combines the pages of --html from src/page/ and three.js, and embeds them.
#   medial_vk_fetch_page_packages(FOLDER result)
#   medial_vk_bundle_page(TARGET PAGE HEADER PACKAGES)
# adds to TARGET a source that defines page::embedded_PAGE(), which HEADER declares: src/page/bundle.mjs defines the pages,
# and PACKAGES is the result of the first call. Without npm, or if its packages cannot be obtained, the pages are empty and
# the build continues: --html then reports the missing program. The packages are sought at every configuration until they
# are present.
option(MEDIAL_VK_PAGE "Bundle the pages that --html writes (needs node and npm)" ON)

# Sets RESULT to the folder with the packages of src/page/package-lock.json, or to nothing after a message with the
# reason.
function(medial_vk_fetch_page_packages folder result)
  set(${result} "" PARENT_SCOPE)
  if(NOT MEDIAL_VK_PAGE)
    return()
  endif()
  find_program(NODE_PROGRAM NAMES node nodejs)
  find_program(NPM_PROGRAM npm)
  if(NOT NODE_PROGRAM OR NOT NPM_PROGRAM)
    message(STATUS "No npm: the tool is built without the page of --html (docs/viewer.md)")
    return()
  endif()
  execute_process(COMMAND ${NODE_PROGRAM} --version OUTPUT_VARIABLE version OUTPUT_STRIP_TRAILING_WHITESPACE)
  string(REPLACE "v" "" version "${version}")
  if(version VERSION_LESS 18)
    message(STATUS "node ${version} is older than 18: the tool is built without the page of --html (docs/viewer.md)")
    return()
  endif()
  set(inputs ${PROJECT_SOURCE_DIR}/src/page/package.json ${PROJECT_SOURCE_DIR}/src/page/package-lock.json)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${inputs})
  file(SHA256 ${PROJECT_SOURCE_DIR}/src/page/package-lock.json wanted)
  set(there "")
  if(EXISTS ${folder}/fetched)
    file(READ ${folder}/fetched there)
  endif()
  if(NOT there STREQUAL wanted)
    file(MAKE_DIRECTORY ${folder})
    file(COPY ${inputs} DESTINATION ${folder})
    message(STATUS "Fetching the packages of the page (npm ci)")
    execute_process(
      COMMAND ${NPM_PROGRAM} ci --ignore-scripts --no-audit --no-fund --prefer-offline --fetch-retries=1
              --fetch-timeout=60000 --loglevel=error
      WORKING_DIRECTORY ${folder} RESULT_VARIABLE failed ERROR_VARIABLE why OUTPUT_QUIET TIMEOUT 300)
    if(NOT failed)  # The bundler is a program for one kind of machine: does it run here?
      execute_process(COMMAND ${NODE_PROGRAM} node_modules/esbuild/bin/esbuild --version
        WORKING_DIRECTORY ${folder} RESULT_VARIABLE failed ERROR_VARIABLE why OUTPUT_QUIET)
    endif()
    if(failed)
      string(REGEX MATCH "^[^\n]*(\n[^\n]*)?(\n[^\n]*)?(\n[^\n]*)?" why "${why}")  # Its first lines state the reason.
      message(STATUS "npm could not fetch the packages of the page (${failed}): the tool is built without it\n${why}")
      return()
    endif()
    file(WRITE ${folder}/fetched ${wanted})
  endif()
  set(${result} ${folder}/node_modules PARENT_SCOPE)
endfunction()

function(medial_vk_bundle_page target name header packages)
  set(out ${CMAKE_CURRENT_BINARY_DIR}/page)
  set(page "")
  if(packages)
    set(page ${out}/${name}.html)
    set(sources ${PROJECT_SOURCE_DIR}/src/page)
    file(GLOB_RECURSE inputs CONFIGURE_DEPENDS ${sources}/*.js ${sources}/*.mjs ${sources}/*.css ${sources}/*.html
         ${sources}/*.glsl)
    add_custom_command(OUTPUT ${page}
      COMMAND ${NODE_PROGRAM} ${sources}/bundle.mjs ${packages} ${name} ${page}
      DEPENDS ${inputs} ${out}/fetched COMMENT "Bundling ${name} of --html" VERBATIM)
  endif()
  set(script ${PROJECT_SOURCE_DIR}/cmake/WriteEmbeddedPage.cmake)
  # The file depends on whether there is a page, so that the other source is generated when npm appears or disappears.
  if(packages)
    set(embedded ${out}/embedded_${name}.cpp)
  else()
    set(embedded ${out}/no_${name}.cpp)
    file(REMOVE ${out}/${name}.html)
  endif()
  add_custom_command(OUTPUT ${embedded}
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${embedded} -DPAGE=${page} -DNAME=${name} -DHEADER=${header} -P ${script}
    DEPENDS ${page} ${script} COMMENT "Embedding ${name} of --html" VERBATIM)
  target_sources(${target} PRIVATE ${embedded})
endfunction()
