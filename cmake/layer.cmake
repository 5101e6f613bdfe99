# seldinger_layer(NAME SOURCES ... LINKS ... PRIVATE_LINKS ...): one folder is one static library. Its LINKS are the
# layers its headers use; PRIVATE_LINKS are used by its .cpp files only (the third-party doors).
# tests/repo reads every #include and holds the same line.
function(seldinger_layer NAME)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINKS;PRIVATE_LINKS" ${ARGN})
  add_library(seldinger_${NAME} STATIC ${ARG_SOURCES})
  set(links)
  foreach(layer ${ARG_LINKS})
    list(APPEND links seldinger_${layer})
  endforeach()
  target_link_libraries(seldinger_${NAME} PUBLIC seldinger_options ${links} PRIVATE ${ARG_PRIVATE_LINKS})
endfunction()
