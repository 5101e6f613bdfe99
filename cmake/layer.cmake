# Several sources are compiled as one (a unity build): what they all include is read once, which makes a build from
# nothing more than twice as fast (docs/decisions/0039). SELDINGER_UNITY=OFF, for tools that look at single files.
option(SELDINGER_UNITY "compile a folder's sources together" ON)

# seldinger_headers(NAME MORE ...): what most of the product's sources include, precompiled for a pace (docs/decisions/0067).
# Not by absolute paths: one checkout's serves another.
set(pace hurried)
file(GENERATE OUTPUT ${CMAKE_BINARY_DIR}/generated/headers.cpp CONTENT "// Nothing but what it makes of its headers.\n")
function(seldinger_headers NAME)
  add_library(${NAME} OBJECT ${CMAKE_BINARY_DIR}/generated/headers.cpp)
  target_link_libraries(${NAME} PRIVATE seldinger_options)
  seldinger_precompile(${NAME} <algorithm> <array> <bit> <charconv> <cmath> <cstdint> <cstdio> <filesystem>
    <functional> <map> <memory> <numeric> <optional> <set> <span> <sstream> <string> <string_view> <tuple> <utility>
    <variant> <vector> <sim/base/result.h> ${ARGN})
endfunction()

# seldinger_layer(NAME LINKS ... PRIVATE_LINKS ...): the sources of this folder are one static library. LINKS are the
# folders whose headers it includes, by the names of their targets (tests/repo holds them against every #include);
# PRIVATE_LINKS are third-party packages, behind the folder's door.
function(seldinger_layer NAME)
  cmake_parse_arguments(ARG "" "" "LINKS;PRIVATE_LINKS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  list(FILTER sources EXCLUDE REGEX "/main\\.cpp$")
  add_library(seldinger_${NAME} STATIC ${sources})
  set_target_properties(seldinger_${NAME} PROPERTIES UNITY_BUILD ${SELDINGER_UNITY} UNITY_BUILD_BATCH_SIZE 8 OPTIMIZE_DEPENDENCIES ON)
  if(SELDINGER_UNITY)
    target_precompile_headers(seldinger_${NAME} REUSE_FROM seldinger_${pace}_headers)
  endif()
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
  set(pace unhurried)
  if(NOT TARGET seldinger_unhurried_headers)
    seldinger_headers(seldinger_unhurried_headers <sim/case/case.h>)
  endif()
endmacro()
