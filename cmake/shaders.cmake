# seldinger_embed_shaders(TARGET NAME SHADER...): validates shaders/SHADER with glslangValidator, flattens its
# #include "shared/…" lines and builds the result into TARGET as embedded::NAME().
find_program(GLSLANG glslangValidator REQUIRED)
function(seldinger_embed_shaders TARGET NAME)
  file(GLOB shared CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/shaders/shared/*.glsl.h)
  set(flat_files)
  foreach(shader ${ARGN})
    set(flat ${CMAKE_CURRENT_BINARY_DIR}/${shader})
    add_custom_command(OUTPUT ${flat}
      COMMAND ${CMAKE_COMMAND} -DGLSLANG=${GLSLANG} -DSHADERS=${PROJECT_SOURCE_DIR}/shaders -DSHADER=${shader}
              -DOUTPUT=${flat} -P ${PROJECT_SOURCE_DIR}/cmake/flatten_shader.cmake
      DEPENDS ${PROJECT_SOURCE_DIR}/shaders/${shader} ${shared} ${PROJECT_SOURCE_DIR}/cmake/flatten_shader.cmake
      VERBATIM)
    list(APPEND flat_files ${flat})
  endforeach()
  seldinger_embed(${TARGET} ${NAME} ${flat_files})
endfunction()
