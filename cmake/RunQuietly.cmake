# cmake -P RunQuietly.cmake -- COMMAND ...: runs the command, and shows its output only if it fails. For spirv-opt, which
# remarks on every function that it does not inline.
set(command)
foreach(i RANGE 4 ${CMAKE_ARGC})
  if(DEFINED CMAKE_ARGV${i})
    list(APPEND command "${CMAKE_ARGV${i}}")
  endif()
endforeach()
execute_process(COMMAND ${command} OUTPUT_VARIABLE output ERROR_VARIABLE output RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${command}: ${result}\n${output}")
endif()
