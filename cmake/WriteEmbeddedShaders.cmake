# Script: writes OUTPUT, a C++ file with the words of every file in SPIRV_FILES.
set(text "// Made by the build from shaders/*/*.comp.\n#include \"device/embedded_shaders.h\"\n\n#include <array>\n\nnamespace medial_vk {\nnamespace {\n")
set(table "")
set(count 0)
foreach(file ${SPIRV_FILES})
  get_filename_component(name ${file} NAME_WE)
  file(READ ${file} hex HEX)
  # SPIR-V on a little-endian machine: the bytes of each word, first byte lowest.
  string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words "${hex}")
  string(REGEX REPLACE "((0x........,)(0x........,)(0x........,)(0x........,)(0x........,)(0x........,)(0x........,)(0x........,))" "\\1\n" words "${words}")
  string(APPEND text "constexpr std::uint32_t k_${name}[] = {\n${words}};\n")
  string(APPEND table "    EmbeddedShader{\"${name}\", k_${name}},\n")
  math(EXPR count "${count} + 1")
endforeach()
# std::array, since a plain array cannot be empty, as it is before there are shaders.
string(APPEND text "constexpr std::array<EmbeddedShader, ${count}> kShaders = {\n${table}};\n}  // namespace\n\n")
string(APPEND text "std::span<const EmbeddedShader> embedded_shaders() { return kShaders; }\n}  // namespace medial_vk\n")
file(WRITE ${OUTPUT} "${text}")
