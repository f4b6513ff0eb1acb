# Builds the project SOURCE in BUILD, with no more than a reader of the docs has.
foreach(arguments "-S;${SOURCE};-B;${BUILD};-G;${GENERATOR};-DCMAKE_CXX_FLAGS=-Wall -Wextra -Werror" "--build;${BUILD}")
  execute_process(COMMAND ${CMAKE_COMMAND} ${arguments} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "failed: cmake ${arguments}\n${output}")
  endif()
endforeach()
