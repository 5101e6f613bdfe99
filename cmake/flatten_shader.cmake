# Run by shaders.cmake. The include extension is a compiler's, not GL's: drivers get the flattened text without it.
# glslangValidator knows the stage by the file's ending (.comp, .vert, .frag).
execute_process(COMMAND ${GLSLANG} -E -I${SHADERS} ${SHADERS}/${SHADER} OUTPUT_VARIABLE text RESULT_VARIABLE code)
if(NOT code EQUAL 0)
  message(FATAL_ERROR "${SHADER}: preprocessing failed\n${text}")
endif()
string(REGEX REPLACE "#extension GL_GOOGLE_include_directive[^\n]*\n" "" text "${text}")
string(REGEX REPLACE "#line[^\n]*\n" "" text "${text}")
file(WRITE ${OUTPUT} "${text}")
execute_process(COMMAND ${GLSLANG} ${OUTPUT} OUTPUT_VARIABLE messages RESULT_VARIABLE code)
if(NOT code EQUAL 0)
  file(REMOVE ${OUTPUT})
  message(FATAL_ERROR "${SHADER}: not valid GLSL\n${messages}")
endif()
