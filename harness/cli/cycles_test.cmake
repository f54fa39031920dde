# cmake -DPROGRAM=vsglbench -DBLENDER=blender -DFOLDER=DIR -P cycles_test.cmake
# Exports the Cornell box, renders it in Blender's Cycles as its README says, and holds the ratio of the means within half a
# percent of 1: both solve the same integral there.
execute_process(COMMAND ${PROGRAM} -q export cornell --to ${FOLDER} --width 160 --height 90 --samples 1024
                COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${BLENDER} -b --python ${FOLDER}/render_cycles.py -- --samples 1024
                OUTPUT_VARIABLE output ERROR_VARIABLE output RESULT_VARIABLE result)
if(NOT output MATCHES "ratio of means: ([01])\\.([0-9][0-9][0-9][0-9])")
  message(FATAL_ERROR "no ratio in what Blender printed (${result}):\n${output}")
endif()
math(EXPR ratio "${CMAKE_MATCH_1}${CMAKE_MATCH_2}")  # in ten-thousandths
message(STATUS "ratio of means: ${CMAKE_MATCH_1}.${CMAKE_MATCH_2}")
if(ratio LESS 9950 OR ratio GREATER 10050)
  message(FATAL_ERROR "the ratio of the means is off by more than half a percent")
endif()
