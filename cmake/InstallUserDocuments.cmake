# Run by `cmake --install`: installs the documents that are for users. Those for contributors, and examples, are in the
# source tree only: links to them become their text; sections on the code, the glossary's sections from that of words that
# are not used on, and paragraphs that begin with `Command:` or `Commands:`, which need the source tree, are left out.
# Needs: SOURCE_DIR, WORK_DIR (for the altered copies), DESTINATION (relative to the prefix)
set(contributors architecture decisions performance testing)
string(JOIN "|" names ${contributors})

# user_document(FILE): a copy of FILE in WORK_DIR without references to what is not installed.
function(user_document file)
  file(READ ${SOURCE_DIR}/${file} text)
  string(REGEX REPLACE "\n## (Working on the code|How a mesh flows through the program)\n(#?[^#]|##[#]*[^# ])*\n## " "\n## " text
         "${text}")
  string(REGEX REPLACE "\n## Words that are not used\n.*" "" text "${text}")
  string(REGEX REPLACE " Words that are not used are[ \n]\\[at the end\\]\\([^)]*\\)\\." "" text "${text}")
  string(REGEX REPLACE "\nCommands?: [^\n]+(\n[^\n]+)*" "" text "${text}")
  string(REGEX REPLACE "\n\n\n+" "\n\n" text "${text}")
  string(REGEX REPLACE "\n[|] \\[(${names})\\.md\\][^\n]*" "" text "${text}")
  string(REGEX REPLACE "\\[([^]]*)\\]\\((docs/)?(${names})\\.md[^)]*\\)" "\\1" text "${text}")
  string(REGEX REPLACE "\\[([^]]*)\\]\\((\\.\\./)?examples/[^)]*\\)" "\\1" text "${text}")
  file(WRITE ${WORK_DIR}/${file} "${text}")
endfunction()

file(REMOVE_RECURSE ${WORK_DIR})
file(GLOB documents RELATIVE ${SOURCE_DIR} ${SOURCE_DIR}/docs/*.md)
foreach(name IN LISTS contributors)
  list(REMOVE_ITEM documents docs/${name}.md)
endforeach()
foreach(file IN LISTS documents ITEMS README.md SECURITY.md CHANGELOG.md)
  user_document(${file})
endforeach()
file(GLOB images ${SOURCE_DIR}/docs/images/*.png)
file(COPY ${images} DESTINATION ${WORK_DIR}/docs/images)
file(INSTALL ${WORK_DIR}/ DESTINATION ${CMAKE_INSTALL_PREFIX}/${DESTINATION})
