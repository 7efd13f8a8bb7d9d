# Script, run when a test program has been linked: writes OUTPUT, in which ctest finds one test for each suite of
# PROGRAM, in the form that gtest_discover_tests() would write for each test.
#   cmake -D PROGRAM=FILE -D PREFIX=unit. -D LABEL=unit -D TIMEOUT=SECONDS -D OUTPUT=FILE -P list_suites.cmake
execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE list COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "\n[^ \n][^ \n]*[.]" suites "\n${list}")  # other lines are indented or have spaces
set(text "")
foreach(suite ${suites})
  string(REGEX REPLACE "^\n(.*)[.]$" "\\1" suite "${suite}")
  string(APPEND text "add_test([==[${PREFIX}${suite}]==] [==[${PROGRAM}]==] [==[--gtest_filter=${suite}.*]==])\n"
    "set_tests_properties([==[${PREFIX}${suite}]==] PROPERTIES LABELS [==[${LABEL}]==] TIMEOUT ${TIMEOUT})\n")
endforeach()
if(NOT text)
  message(FATAL_ERROR "${PROGRAM} lists no suites:\n${list}")
endif()
file(WRITE ${OUTPUT} "${text}")
