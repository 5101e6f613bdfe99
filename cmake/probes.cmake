# What a probe is made of in builds other than the product's: bits and scores must not depend on how they were compiled.
# probed_debug and probed_fma hold the layers of the tick and of its metrics, each compiled once for all probes.
# Compiled together folder by folder, since names in anonymous namespaces are unique in one, not among all.
find_library(ZSTD_LIBRARY zstd REQUIRED)
set(probed_layers base volume case_form case case_record tissue haptics_contact haptics_needle haptics_probe haptics_proxy haptics devices engine
  assessment_operators assessment_signals assessment_metrics assessment_procedure assessment)
set(probed_sources)
foreach(layer ${probed_layers})
  get_target_property(sources seldinger_${layer} SOURCES)
  list(APPEND probed_sources ${sources})
endforeach()
# Neither in a tick nor in a metric, and with needs of their own.
list(FILTER probed_sources EXCLUDE REGEX "/embedded_|servo_loop|_markdown|recorder|/operators/(plan|probe_place|lesion_site|organ_places)")
foreach(source ${probed_sources})
  cmake_path(GET source PARENT_PATH folder)
  string(MAKE_C_IDENTIFIER "probed_${folder}" folder)
  set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${folder})
endforeach()
# As in their own folder.
set_source_files_properties(${PROJECT_SOURCE_DIR}/assessment/procedure/steps.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
function(probed_layers_as FLAVOUR)
  add_library(probed_${FLAVOUR} STATIC EXCLUDE_FROM_ALL ${probed_sources})
  set_target_properties(probed_${FLAVOUR} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  target_link_libraries(probed_${FLAVOUR} PUBLIC seldinger_options Threads::Threads ${ZSTD_LIBRARY})
  target_compile_options(probed_${FLAVOUR} PUBLIC ${ARGN})
endfunction()
probed_layers_as(debug -O0 -UNDEBUG)
probed_layers_as(fma -O3 -mavx2 -mfma)

# seldinger_probe(NAME [RELEASED layers ...]): the program of NAME_probe.cpp as NAME_debug and NAME_fma and, of those
# layers as they are released, as NAME_released.
function(seldinger_probe NAME)
  cmake_parse_arguments(ARG "" "" "RELEASED" ${ARGN})
  foreach(flavour debug fma)
    add_executable(${NAME}_${flavour} ${NAME}_probe.cpp)
    target_link_libraries(${NAME}_${flavour} PRIVATE probed_${flavour})
  endforeach()
  if(ARG_RELEASED)
    list(TRANSFORM ARG_RELEASED PREPEND seldinger_)
    add_executable(${NAME}_released ${NAME}_probe.cpp)
    target_link_libraries(${NAME}_released PRIVATE ${ARG_RELEASED})
  endif()
endfunction()
