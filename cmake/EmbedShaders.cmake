# Compiles GLSL compute shaders to SPIR-V, validates them and embeds them as constant arrays.
#   medial_vk_embed_shaders(TARGET SHARED_DIR file1.comp file2.comp ...)
# whose includes are looked up in SHARED_DIR; names of files are unique among all folders. It
# adds to TARGET a source that defines embedded_shaders() (runtime/src/device/embedded_shaders.h). No files: an empty list.
# Those that include lanes.glsl are compiled a second time, with LOCKSTEP defined, as NAME_lockstep; and all that read
# texel buffers once more, with STORAGE defined, as NAME_storage or NAME_lockstep_storage.
#   medial_vk_embed_shaders(... CALLING name1 name2 ...)
# In the variants of these files without LOCKSTEP, functions that return early remain functions that are called. These
# variants are not frozen, since constants do not reach into such functions.
#   medial_vk_embed_shaders(... FROZEN name1=8,false name2=64,0,8 ...)
# Of these files, the variants for texel buffers are built again as NAME_with_8_0, NAME_lockstep_with_8_0: all
# specialization constants, from 0 on, have these values (bools: false or true), and code that these make unreachable is
# removed. For drivers that take long to translate.
find_program(GLSLANG_VALIDATOR glslangValidator REQUIRED)
find_program(SPIRV_OPT spirv-opt REQUIRED)
find_program(SPIRV_VAL spirv-val REQUIRED)

# `spirv-opt -O` merges the returns of such functions, by a switch of one case around each body, and inlines them. With
# this, the SPIR-V compiler of NVIDIA (driver 580) crashes in judge_pairs, at the end of one of its loops. So these are the
# passes of -O of SPIRV-Tools 2023.1 without merge-return.
set(MEDIAL_VK_CALLING_PASSES
  --wrap-opkill --eliminate-dead-branches --inline-entry-points-exhaustive --eliminate-dead-functions
  --eliminate-dead-code-aggressive --private-to-local --eliminate-local-single-block --eliminate-local-single-store
  --eliminate-dead-code-aggressive --scalar-replacement=100 --convert-local-access-chains
  --eliminate-local-single-block --eliminate-local-single-store --eliminate-dead-code-aggressive --ssa-rewrite
  --eliminate-dead-code-aggressive --ccp --eliminate-dead-code-aggressive --loop-unroll --eliminate-dead-branches
  --redundancy-elimination --combine-access-chains --simplify-instructions --scalar-replacement=100
  --convert-local-access-chains --eliminate-local-single-block --eliminate-local-single-store
  --eliminate-dead-code-aggressive --ssa-rewrite --eliminate-dead-code-aggressive --vector-dce --eliminate-dead-inserts
  --eliminate-dead-branches --simplify-instructions --if-conversion --copy-propagate-arrays --reduce-load-size
  --eliminate-dead-code-aggressive --merge-blocks --redundancy-elimination --eliminate-dead-branches --merge-blocks
  --simplify-instructions)

# Sets in the caller: the name of `variant` with the constants `values` (comma-separated), and flags of spirv-opt.
function(_medial_vk_freeze variant values name_out flags_out)
  string(REPLACE "," ";" list "${values}")
  set(id 0)
  set(settings)
  foreach(value ${list})
    list(APPEND settings "${id}:${value}")
    math(EXPR id "${id} + 1")
  endforeach()
  list(JOIN settings " " settings)
  string(REPLACE "false" "0" words "${values}")
  string(REPLACE "true" "1" words "${words}")
  string(REPLACE "," "_" words "${words}")
  set(${name_out} ${variant}_with_${words} PARENT_SCOPE)
  set(${flags_out} "--set-spec-const-default-value=${settings}" --freeze-spec-const --fold-spec-const-op-composite
      PARENT_SCOPE)
endfunction()

# Sets in the caller: the passes of spirv-opt for a variant of the shader `name`.
function(_medial_vk_passes name variant calling passes_out)
  if(name IN_LIST calling AND NOT variant MATCHES "_lockstep")
    set(${passes_out} ${MEDIAL_VK_CALLING_PASSES} PARENT_SCOPE)
  else()
    set(${passes_out} -O PARENT_SCOPE)
  endif()
endfunction()

function(medial_vk_embed_shaders target shared_dir)
  cmake_parse_arguments(arg "" "" "CALLING;FROZEN" ${ARGN})
  set(names)
  foreach(source ${arg_UNPARSED_ARGUMENTS})
    get_filename_component(name ${source} NAME_WE)
    if(name IN_LIST names)
      message(FATAL_ERROR "Two shaders are called ${name}")
    endif()
    list(APPEND names ${name})
  endforeach()
  foreach(named ${arg_CALLING} ${arg_FROZEN})
    string(REGEX REPLACE "=.*" "" name ${named})
    if(NOT name IN_LIST names)
      message(FATAL_ERROR "There is no shader ${name}")
    endif()
  endforeach()
  set(out ${CMAKE_CURRENT_BINARY_DIR}/embedded)
  file(MAKE_DIRECTORY ${out})
  file(GLOB_RECURSE includes CONFIGURE_DEPENDS ${shared_dir}/*.glsl ${shared_dir}/*.h)
  set(spirv_files)
  foreach(source ${arg_UNPARSED_ARGUMENTS})
    get_filename_component(name ${source} NAME_WE)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${source})
    set(variants ${name})
    file(STRINGS ${source} uses_lanes REGEX "include \"lanes/lanes.glsl\"")
    if(uses_lanes)
      list(APPEND variants ${name}_lockstep)
    endif()
    file(STRINGS ${source} uses_texels REGEX
      "include \"(tree/(triangles|tree_query|tree_packet_main)|following/frame).glsl\"")
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
      _medial_vk_passes(${name} ${variant} "${arg_CALLING}" passes)
      add_custom_command(OUTPUT ${spv}
        COMMAND ${GLSLANG_VALIDATOR} --quiet -V --target-env vulkan1.2 ${defines} -I${shared_dir} -I${shared_dir}/types
                -o ${spv}.raw ${source}
        COMMAND ${CMAKE_COMMAND} -P ${PROJECT_SOURCE_DIR}/cmake/RunQuietly.cmake --
                ${SPIRV_OPT} ${passes} ${spv}.raw -o ${spv}
        COMMAND ${SPIRV_VAL} --target-env vulkan1.2 ${spv}
        BYPRODUCTS ${spv}.raw
        DEPENDS ${source} ${includes}
        COMMENT "Shader ${variant}" VERBATIM)
      list(APPEND spirv_files ${spv})
    endforeach()
    set(usual_variants ${name})
    if(name IN_LIST arg_CALLING)
      set(usual_variants)
    endif()
    if(uses_lanes)
      list(APPEND usual_variants ${name}_lockstep)
    endif()
    foreach(frozen ${arg_FROZEN})
      if(NOT frozen MATCHES "^${name}=(.*)$")
        continue()
      endif()
      set(values ${CMAKE_MATCH_1})
      foreach(usual ${usual_variants})
        _medial_vk_freeze(${usual} ${values} variant flags)
        set(spv ${out}/${variant}.spv)
        add_custom_command(OUTPUT ${spv}
          COMMAND ${SPIRV_OPT} ${flags} -O ${out}/${usual}.spv.raw -o ${spv}
          COMMAND ${SPIRV_VAL} --target-env vulkan1.2 ${spv}
          DEPENDS ${out}/${usual}.spv
          COMMENT "Shader ${variant}" VERBATIM)
        list(APPEND spirv_files ${spv})
      endforeach()
    endforeach()
  endforeach()
  add_custom_command(OUTPUT ${out}/embedded_shaders.cpp
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${out}/embedded_shaders.cpp "-DSPIRV_FILES=${spirv_files}"
            -P ${PROJECT_SOURCE_DIR}/cmake/WriteEmbeddedShaders.cmake
    DEPENDS ${spirv_files} ${PROJECT_SOURCE_DIR}/cmake/WriteEmbeddedShaders.cmake
    COMMENT "Embedding SPIR-V" VERBATIM)
  target_sources(${target} PRIVATE ${out}/embedded_shaders.cpp)
endfunction()
