# Compiles GLSL compute shaders to SPIR-V, validates them and embeds them as constant arrays.
#   medial_vk_embed_shaders(TARGET SHADER_DIR name1 name2 ...)
# adds to TARGET a source that defines embedded_shaders() (runtime/src/embedded_shaders.h). No names: an empty list.
# Those that include lanes.glsl are compiled a second time, with LOCKSTEP defined, as NAME_lockstep; and all that read
# texel buffers once more, with STORAGE defined, as NAME_storage or NAME_lockstep_storage.
find_program(GLSLANG_VALIDATOR glslangValidator REQUIRED)
find_program(SPIRV_OPT spirv-opt REQUIRED)
find_program(SPIRV_VAL spirv-val REQUIRED)

function(medial_vk_embed_shaders target shader_dir)
  set(out ${CMAKE_CURRENT_BINARY_DIR}/embedded)
  file(MAKE_DIRECTORY ${out})
  file(GLOB includes CONFIGURE_DEPENDS ${shader_dir}/shared/*.glsl ${shader_dir}/shared/*.h)
  set(spirv_files)
  foreach(name ${ARGN})
    set(source ${shader_dir}/${name}.comp)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${source})
    set(variants ${name})
    file(STRINGS ${source} uses_lanes REGEX "include \"lanes.glsl\"")
    if(uses_lanes)
      list(APPEND variants ${name}_lockstep)
    endif()
    file(STRINGS ${source} uses_texels REGEX "include \"(triangles|tree_query|tree_packet_main).glsl\"")
    if(uses_texels)
      list(TRANSFORM variants APPEND _storage OUTPUT_VARIABLE storage_variants)
      list(APPEND variants ${storage_variants})
    endif()
    foreach(variant ${variants})
      set(spv ${out}/${variant}.spv)
      set(defines)
      if(variant MATCHES "_lockstep")
        list(APPEND defines -DLOCKSTEP)
      endif()
      if(variant MATCHES "_storage$")
        list(APPEND defines -DSTORAGE)
      endif()
      add_custom_command(OUTPUT ${spv}
        COMMAND ${GLSLANG_VALIDATOR} --quiet -V --target-env vulkan1.2 ${defines} -I${shader_dir}/shared
                -o ${spv}.raw ${source}
        COMMAND ${SPIRV_OPT} -O ${spv}.raw -o ${spv}
        COMMAND ${SPIRV_VAL} --target-env vulkan1.2 ${spv}
        DEPENDS ${source} ${includes}
        COMMENT "Shader ${variant}" VERBATIM)
      list(APPEND spirv_files ${spv})
    endforeach()
  endforeach()
  add_custom_command(OUTPUT ${out}/embedded_shaders.cpp
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${out}/embedded_shaders.cpp "-DSPIRV_FILES=${spirv_files}"
            -P ${PROJECT_SOURCE_DIR}/cmake/WriteEmbeddedShaders.cmake
    DEPENDS ${spirv_files} ${PROJECT_SOURCE_DIR}/cmake/WriteEmbeddedShaders.cmake
    COMMENT "Embedding SPIR-V" VERBATIM)
  target_sources(${target} PRIVATE ${out}/embedded_shaders.cpp)
endfunction()
