# Compile options of every target. Warnings are errors; -ffp-contract=off keeps bits equal with and without FMA.
add_library(seldinger_options INTERFACE)
target_compile_options(seldinger_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor -Wold-style-cast -Werror
  -ffp-contract=off)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(seldinger_options INTERFACE -Wno-subobject-linkage) # a unity build's sources are one file to it
endif()
target_include_directories(seldinger_options INTERFACE ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR}/generated)
target_compile_definitions(seldinger_options INTERFACE GLM_FORCE_CTOR_INIT GLM_ENABLE_EXPERIMENTAL)
if(SELDINGER_SANITIZE STREQUAL "thread")
  target_compile_options(seldinger_options INTERFACE -fsanitize=thread -fno-omit-frame-pointer)
  target_link_options(seldinger_options INTERFACE -fsanitize=thread)
elseif(SELDINGER_SANITIZE)
  target_compile_options(seldinger_options INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=undefined
                                                    -fno-omit-frame-pointer)
  target_link_options(seldinger_options INTERFACE -fsanitize=address,undefined)
  target_compile_definitions(seldinger_options INTERFACE _GLIBCXX_ASSERTIONS) # empty optionals, indices out of range
endif()
