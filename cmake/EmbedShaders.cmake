# Compiles GLSL compute shaders to SPIR-V, validates them and embeds them as constant arrays.
#   medial_vk_embed_shaders(TARGET SHADER_DIR name1 name2 ...)
# adds to TARGET a source that defines embedded_shaders() (runtime/src/embedded_shaders.h). No names: an empty list.
find_program(GLSLANG_VALIDATOR glslangValidator REQUIRED)
find_program(SPIRV_OPT spirv-opt REQUIRED)
find_program(SPIRV_VAL spirv-val REQUIRED)

function(medial_vk_embed_shaders target shader_dir)
  set(out ${CMAKE_CURRENT_BINARY_DIR}/embedded)
  file(MAKE_DIRECTORY ${out})
  file(GLOB includes CONFIGURE_DEPENDS ${shader_dir}/shared/*.glsl ${shader_dir}/shared/*.h)
  set(spirv_files)
  foreach(name ${ARGN})
    set(spv ${out}/${name}.spv)
    add_custom_command(OUTPUT ${spv}
      COMMAND ${GLSLANG_VALIDATOR} --quiet -V --target-env vulkan1.2 -I${shader_dir}/shared -o ${spv}.raw
              ${shader_dir}/${name}.comp
      COMMAND ${SPIRV_OPT} -O ${spv}.raw -o ${spv}
      COMMAND ${SPIRV_VAL} --target-env vulkan1.2 ${spv}
      DEPENDS ${shader_dir}/${name}.comp ${includes}
      COMMENT "Shader ${name}" VERBATIM)
    list(APPEND spirv_files ${spv})
  endforeach()
  add_custom_command(OUTPUT ${out}/embedded_shaders.cpp
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${out}/embedded_shaders.cpp "-DSPIRV_FILES=${spirv_files}"
            -P ${PROJECT_SOURCE_DIR}/cmake/WriteEmbeddedShaders.cmake
    DEPENDS ${spirv_files} ${PROJECT_SOURCE_DIR}/cmake/WriteEmbeddedShaders.cmake
    COMMENT "Embedding SPIR-V" VERBATIM)
  target_sources(${target} PRIVATE ${out}/embedded_shaders.cpp)
endfunction()
