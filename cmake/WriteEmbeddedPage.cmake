# Script: writes OUTPUT, a C++ file with page::embedded_NAME(), declared in HEADER: the bytes of PAGE, or none if PAGE is
# empty.
set(text "// Made by the build from src/page/.\n#include \"${HEADER}\"\n\nnamespace medial_vk::page {\n")
if(PAGE)
  file(READ ${PAGE} hex HEX)
  string(REGEX REPLACE "(................................................................)" "\\1\n" hex "${hex}")
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "'\\\\x\\1'," bytes "${hex}")
  string(APPEND text "static constexpr char kPage[] = {\n${bytes}};\n\n")
  string(APPEND text "std::string_view embedded_${NAME}() { return {kPage, sizeof(kPage)}; }\n")
else()
  string(APPEND text "\nstd::string_view embedded_${NAME}() { return {}; }\n")
endif()
string(APPEND text "\n}  // namespace medial_vk::page\n")
file(WRITE ${OUTPUT} "${text}")
