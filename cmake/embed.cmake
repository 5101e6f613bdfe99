# seldinger_embed(TARGET NAME FILE...): builds FILEs into TARGET as
#   std::span<const seldinger::base::EmbeddedFile> seldinger::embedded::NAME();
function(seldinger_embed TARGET NAME)
  set(output ${CMAKE_CURRENT_BINARY_DIR}/embedded_${NAME}.cpp)
  string(REPLACE ";" "|" files "${ARGN}")
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${output} -DNAME=${NAME} "-DFILES=${files}"
            -P ${PROJECT_SOURCE_DIR}/cmake/embed_files.cmake
    DEPENDS ${ARGN} ${PROJECT_SOURCE_DIR}/cmake/embed_files.cmake VERBATIM)
  target_sources(${TARGET} PRIVATE ${output})
endfunction()
