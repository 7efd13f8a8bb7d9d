# Combines the pages of --html from src/page/ and three.js, and embeds them.
#   medial_vk_find_page_packages(result)
#   medial_vk_bundle_page(TARGET PAGE HEADER PACKAGES)
# adds to TARGET a source that defines page::embedded_PAGE(), which HEADER declares: src/page/bundle.mjs defines the pages,
# and PACKAGES is the result of the first call. Without npm, or if its packages cannot be obtained, the pages are empty and
# the build continues: --html then reports the missing program. The packages are sought at every configuration until they
# are present.
option(MEDIAL_VK_PAGE "Bundle the pages that --html writes (needs node and npm)" ON)

set(MEDIAL_VK_PAGE_PACKAGES ${CMAKE_CURRENT_BINARY_DIR}/page CACHE PATH
  "Folder of the packages of the page; those that FetchPagePackages.cmake has fetched before are not fetched again")
include(FetchPagePackages)

# Sets RESULT to the folder with the packages of src/page/package-lock.json, or to nothing after a message with the reason.
function(medial_vk_find_page_packages result)
  set(packages "")
  if(MEDIAL_VK_PAGE)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
      ${PROJECT_SOURCE_DIR}/src/page/package.json ${PROJECT_SOURCE_DIR}/src/page/package-lock.json)
    medial_vk_fetch_page_packages(${MEDIAL_VK_PAGE_PACKAGES} packages)
  endif()
  set(${result} "${packages}" PARENT_SCOPE)
endfunction()

function(medial_vk_bundle_page target name header packages)
  set(out ${CMAKE_CURRENT_BINARY_DIR}/page)
  set(page "")
  if(packages)
    file(MAKE_DIRECTORY ${out})
    set(page ${out}/${name}.html)
    set(sources ${PROJECT_SOURCE_DIR}/src/page)
    file(GLOB_RECURSE inputs CONFIGURE_DEPENDS ${sources}/*.js ${sources}/*.mjs ${sources}/*.css ${sources}/*.html
         ${sources}/*.glsl)
    add_custom_command(OUTPUT ${page}
      COMMAND ${NODE_PROGRAM} ${sources}/bundle.mjs ${packages} ${name} ${page}
      DEPENDS ${inputs} ${packages}/../fetched COMMENT "Bundling ${name} of --html" VERBATIM)
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
