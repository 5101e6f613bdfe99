# seldinger_layer(NAME LINKS ... PRIVATE_LINKS ...): the sources of this folder are one static library. LINKS are the
# folders whose headers it includes, by the names of their targets (tests/repo holds them against every #include);
# PRIVATE_LINKS are third-party packages, behind the folder's door.
# Several sources are compiled as one (a unity build): what they all include is read once, which makes a build from
# nothing more than twice as fast (docs/decisions/0039). SELDINGER_UNITY=OFF, for tools that look at single files.
option(SELDINGER_UNITY "compile a folder's sources together" ON)
function(seldinger_layer NAME)
  cmake_parse_arguments(ARG "" "" "LINKS;PRIVATE_LINKS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  list(FILTER sources EXCLUDE REGEX "/main\\.cpp$")
  add_library(seldinger_${NAME} STATIC ${sources})
  set_target_properties(seldinger_${NAME} PROPERTIES UNITY_BUILD ${SELDINGER_UNITY} UNITY_BUILD_BATCH_SIZE 8 OPTIMIZE_DEPENDENCIES ON)
  set(links)
  foreach(layer ${ARG_LINKS})
    list(APPEND links seldinger_${layer})
  endforeach()
  target_link_libraries(seldinger_${NAME} PUBLIC seldinger_options ${links} PRIVATE ${ARG_PRIVATE_LINKS})
endfunction()

# seldinger_unhurried(): what this folder and the folders added after this line compile is seldom waited for in a
# loop (commands, windows, pages, rows): -O1 takes a quarter off the time of a build, -O0 a quarter off that of the
# sanitizers' (docs/decisions/0039).
# g++ 12 then takes the text inside a std::string or std::optional for something else (gcc.gnu.org/PR105329, PR80635).
macro(seldinger_unhurried)
  if(CMAKE_BUILD_TYPE STREQUAL Release)
    add_compile_options(-O1)
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
      add_compile_options(-Wno-array-bounds -Wno-stringop-overflow -Wno-restrict -Wno-maybe-uninitialized)
    endif()
  elseif(SELDINGER_SANITIZE STREQUAL address)
    add_compile_options(-O0)
  endif()
endmacro()
