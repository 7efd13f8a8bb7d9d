# The packages of the pages of --html: those that src/page/package-lock.json names with their hashes.
#   medial_vk_fetch_page_packages(FOLDER result)
# Sets RESULT to the folder FOLDER/node_modules with the packages, or to nothing after a message with the reason. npm fetches
# them, unless they are there already: FOLDER/fetched has the digest of the lock file that they were fetched for.
#   cmake -DFOLDER=FOLDER -P FetchPagePackages.cmake
# does the same, and fails where they cannot be had: for builds without a network, such as that of scripts/build-deb.
set(MEDIAL_VK_PAGE_SOURCES ${CMAKE_CURRENT_LIST_DIR}/../src/page)

function(medial_vk_fetch_page_packages folder result)
  set(${result} "" PARENT_SCOPE)
  find_program(NODE_PROGRAM NAMES node nodejs)
  find_program(NPM_PROGRAM npm)
  file(SHA256 ${MEDIAL_VK_PAGE_SOURCES}/package-lock.json wanted)
  set(there "")
  if(EXISTS ${folder}/fetched)
    file(READ ${folder}/fetched there)
  endif()
  if(NOT NODE_PROGRAM OR (NOT NPM_PROGRAM AND NOT there STREQUAL wanted))
    message(STATUS "No npm: the tool is built without the page of --html (docs/viewer.md)")
    return()
  endif()
  execute_process(COMMAND ${NODE_PROGRAM} --version OUTPUT_VARIABLE version OUTPUT_STRIP_TRAILING_WHITESPACE)
  string(REPLACE "v" "" version "${version}")
  if(version VERSION_LESS 18)
    message(STATUS "node ${version} is older than 18: the tool is built without the page of --html (docs/viewer.md)")
    return()
  endif()
  if(NOT there STREQUAL wanted)
    file(MAKE_DIRECTORY ${folder})
    file(COPY ${MEDIAL_VK_PAGE_SOURCES}/package.json ${MEDIAL_VK_PAGE_SOURCES}/package-lock.json DESTINATION ${folder})
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

if(CMAKE_SCRIPT_MODE_FILE STREQUAL CMAKE_CURRENT_LIST_FILE)
  get_filename_component(folder "${FOLDER}" ABSOLUTE)
  medial_vk_fetch_page_packages("${folder}" packages)
  if(NOT packages)
    message(FATAL_ERROR "The packages of the page are missing")
  endif()
endif()
