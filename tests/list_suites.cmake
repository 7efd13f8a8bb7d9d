# Script, run when a test program has been linked: writes OUTPUT, in which ctest finds one test for each suite of
# PROGRAM, in the form that gtest_discover_tests() would write for each test.
# The tests in SLOW are left out of their suites and are tests of their own, labelled `sanitized_full`, too, as are
# whole suites there (Suite.*).
#   cmake -D PROGRAM=FILE -D PREFIX=unit. -D LABEL=unit -D TIMEOUT=SECONDS -D SLOW=Suite.Test,Suite.*,... -D OUTPUT=FILE
#     [-D EMULATOR=COMMAND] -P list_suites.cmake
# EMULATOR: by which programs of another architecture run here.
cmake_minimum_required(VERSION 3.25)
execute_process(COMMAND ${EMULATOR} ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE list COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "\n[^ \n][^ \n]*[.]" suites "\n${list}")  # other lines are indented or have spaces
string(REPLACE "," ";" slow "${SLOW}")
set(text "")
set(command "")
foreach(word ${EMULATOR} ${PROGRAM})
  string(APPEND command "[==[${word}]==] ")
endforeach()
# add(NAME FILTER LABELS)
function(add name filter labels)
  string(APPEND text "add_test([==[${PREFIX}${name}]==] ${command}[==[--gtest_filter=${filter}]==])\n"
    "set_tests_properties([==[${PREFIX}${name}]==] PROPERTIES LABELS [==[${labels}]==] TIMEOUT ${TIMEOUT})\n")
  set(text "${text}" PARENT_SCOPE)
endfunction()
foreach(suite ${suites})
  string(REGEX REPLACE "^\n(.*)[.]$" "\\1" suite "${suite}")
  if("${suite}.*" IN_LIST slow)
    list(REMOVE_ITEM slow "${suite}.*")
    add(${suite} "${suite}.*" "${LABEL};sanitized_full")
    continue()
  endif()
  set(without ${slow})
  list(FILTER without INCLUDE REGEX "^${suite}[.]")
  string(JOIN ":" without ${without})
  if(without)
    string(PREPEND without "-")
  endif()
  add(${suite} "${suite}.*${without}" "${LABEL}")
endforeach()
foreach(test ${slow})
  string(REGEX REPLACE "^.*[.]" "  " name "${test}")
  string(FIND "${list}" "${name}\n" position)
  if(position EQUAL -1)
    message(FATAL_ERROR "${PROGRAM} has no test ${test}")
  endif()
  add(${test} "${test}" "${LABEL};sanitized_full")
endforeach()
if(NOT text)
  message(FATAL_ERROR "${PROGRAM} lists no suites:\n${list}")
endif()
file(WRITE ${OUTPUT} "${text}")
