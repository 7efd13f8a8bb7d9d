# Compiles GLSL shaders of the graphics stages to SPIR-V, validates them and generates a header for each:
#   medial_vk_embed_drawing_shaders(TARGET FOLDER mesh.vert mesh.frag ...)
# mesh.vert becomes the array kMeshVert in mesh.vert.h, which TARGET can include.
find_program(GLSLANG_VALIDATOR glslangValidator REQUIRED)
find_program(SPIRV_VAL spirv-val REQUIRED)

function(medial_vk_embed_drawing_shaders target folder)
  set(out ${CMAKE_CURRENT_BINARY_DIR}/drawing_shaders)
  file(MAKE_DIRECTORY ${out})
  file(GLOB includes CONFIGURE_DEPENDS ${folder}/*.glsl)
  set(compile ${GLSLANG_VALIDATOR} --quiet -V --target-env vulkan1.2 -I${folder})
  foreach(shader ${ARGN})
    string(REGEX MATCH "^(.)(.*)[.](.)(.*)$" matched ${shader})
    string(TOUPPER ${CMAKE_MATCH_1} first)
    string(TOUPPER ${CMAKE_MATCH_3} stage_first)
    set(variable k${first}${CMAKE_MATCH_2}${stage_first}${CMAKE_MATCH_4})
    add_custom_command(OUTPUT ${out}/${shader}.h
      COMMAND ${compile} -o ${out}/${shader}.spv ${folder}/${shader}
      COMMAND ${SPIRV_VAL} --target-env vulkan1.2 ${out}/${shader}.spv
      COMMAND ${compile} --vn ${variable} -o ${out}/${shader}.h ${folder}/${shader}
      DEPENDS ${folder}/${shader} ${includes}
      COMMENT "Shader ${shader}" VERBATIM)
    target_sources(${target} PRIVATE ${out}/${shader}.h)
  endforeach()
  target_include_directories(${target} PRIVATE ${out})
endfunction()
