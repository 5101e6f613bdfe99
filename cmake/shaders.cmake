# seldinger_embed_shaders(TARGET NAME FOLDER): validates every shader of shaders/FOLDER with glslangValidator, flattens
# its #include lines, which are meant from shaders/, and builds the result into TARGET as embedded::NAME().
find_program(GLSLANG glslangValidator REQUIRED)
function(seldinger_embed_shaders TARGET NAME FOLDER)
  set(folder ${PROJECT_SOURCE_DIR}/shaders/${FOLDER})
  file(GLOB shaders CONFIGURE_DEPENDS ${folder}/*.comp ${folder}/*.vert ${folder}/*.frag)
  file(GLOB included CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/shaders/shared/*.glsl.h ${folder}/*.glsl)
  set(flat_files)
  foreach(shader ${shaders})
    get_filename_component(file ${shader} NAME)
    set(flat ${CMAKE_CURRENT_BINARY_DIR}/${file})
    add_custom_command(OUTPUT ${flat}
      COMMAND ${CMAKE_COMMAND} -DGLSLANG=${GLSLANG} -DSHADERS=${PROJECT_SOURCE_DIR}/shaders -DSHADER=${FOLDER}/${file}
              -DOUTPUT=${flat} -P ${PROJECT_SOURCE_DIR}/cmake/flatten_shader.cmake
      DEPENDS ${shader} ${included} ${PROJECT_SOURCE_DIR}/cmake/flatten_shader.cmake
      VERBATIM)
    list(APPEND flat_files ${flat})
  endforeach()
  seldinger_embed(${TARGET} ${NAME} ${flat_files})
endfunction()
