# Headers are included as <placegraph/folder/file.h>, in the source tree as after installation: the
# build tree gets a folder `placegraph` whose entries point at the source folders.
set(PLACEGRAPH_INCLUDE_DIR ${PROJECT_BINARY_DIR}/include)
file(MAKE_DIRECTORY ${PLACEGRAPH_INCLUDE_DIR}/placegraph)
foreach(folder graph frontend backend io eval pipeline)
  file(CREATE_LINK ${PROJECT_SOURCE_DIR}/${folder} ${PLACEGRAPH_INCLUDE_DIR}/placegraph/${folder} SYMBOLIC)
endforeach()

# Eigen aligns its types, and allocates, by what instructions a source is compiled for. Types that cross the
# library's boundary must be alike on both sides, so who uses the library takes what every processor offers: 16
# bytes, as malloc aligns. (graph/geometry/so3.h asserts it.)
set(PLACEGRAPH_EIGEN_ALIGNMENT EIGEN_MAX_ALIGN_BYTES=16 EIGEN_MALLOC_ALREADY_ALIGNED=1)

# The header of all doors stands beside the folders.
file(CREATE_LINK ${PROJECT_SOURCE_DIR}/pipeline/placegraph.h ${PLACEGRAPH_INCLUDE_DIR}/placegraph/placegraph.h SYMBOLIC)

# GCC takes fixed-size Eigen decompositions for uninitialized wherever it inlines them.
function(placegraph_compile_options target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wshadow -Wnon-virtual-dtor
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized> $<$<BOOL:${PLACEGRAPH_WERROR}>:-Werror>)
endfunction()

# placegraph_unity(target [ACROSS_FOLDERS]): sources of one folder are compiled together, eight at a time,
# because half of compiling a source is reading headers and instantiating templates. What sources of one
# unit keep to themselves needs different names (functions: other parameters). ACROSS_FOLDERS takes sixteen at a time, whatever their folders. A
# source with the property SKIP_UNITY_BUILD_INCLUSION is compiled alone: it pays where a source instantiates
# so much of its own that GCC, whose time grows faster than the number of types, takes longer for all at once.
# PLACEGRAPH_UNITY=OFF compiles each alone, which is quicker where one is changed again and again.
# (CMake's own unity builds name the sources by absolute paths, which the compiler cache of another clone
# cannot find.)
function(placegraph_unity target)
  cmake_parse_arguments(ARG "ACROSS_FOLDERS" "" "" ${ARGN})
  if(NOT PLACEGRAPH_UNITY)
    return()
  endif()
  # Files compiled together see each other's using-declarations, which their variables then "shadow".
  target_compile_options(${target} PRIVATE -Wno-shadow)
  target_include_directories(${target} PRIVATE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
  get_target_property(sources ${target} SOURCES)
  set(compiled)
  set(units)
  set(group ${target})
  set(size 16)
  foreach(source IN LISTS sources)
    get_source_file_property(alone ${source} SKIP_UNITY_BUILD_INCLUSION)
    if(alone OR IS_ABSOLUTE "${source}")
      list(APPEND compiled ${source})
      continue()
    endif()
    if(NOT ARG_ACROSS_FOLDERS)
      cmake_path(GET source PARENT_PATH folder)
      string(MAKE_C_IDENTIFIER "${target}_${folder}" group)
      set(size 8)
    endif()
    math(EXPR count_${group} "${count_${group}} + 1")
    math(EXPR part "(${count_${group}} + ${size} - 1) / ${size}")
    set(unit ${group}_${part})
    file(RELATIVE_PATH path ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR}/${source})
    string(APPEND content_${unit} "#include \"${path}\"\n")
    list(APPEND units ${unit})
  endforeach()
  list(REMOVE_DUPLICATES units)
  foreach(unit IN LISTS units)
    set(file ${CMAKE_CURRENT_BINARY_DIR}/unity/${unit}.cpp)
    file(CONFIGURE OUTPUT ${file} CONTENT "${content_${unit}}" @ONLY)
    list(APPEND compiled ${file})
  endforeach()
  set_target_properties(${target} PROPERTIES SOURCES "${compiled}")
endfunction()

# placegraph_library(name SOURCES ... [PUBLIC targets] [PRIVATE targets]
#                    [PRECOMPILE headers | PRECOMPILED_BY library] [ACROSS_FOLDERS] [INTERNAL])
# makes the static library placegraph_<name>, alias placegraph::<name>. PRECOMPILED_BY takes the precompiled headers of another
# library, whose options must be the same. ACROSS_FOLDERS: as placegraph_unity; it pays where sources instantiate little
# of their own (io: 19 units 76 s, 6 units 71 s on a busier machine), not elsewhere (backend: 19 units 272 s, 6 units
# 514 s). INTERNAL: it has no public header and is not installed.
function(placegraph_library name)
  cmake_parse_arguments(ARG "ACROSS_FOLDERS;INTERNAL" "PRECOMPILED_BY" "SOURCES;PUBLIC;PRIVATE;PRECOMPILE" ${ARGN})
  set(target placegraph_${name})
  add_library(${target} STATIC ${ARG_SOURCES})
  add_library(placegraph::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${PLACEGRAPH_INCLUDE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_compile_definitions(${target} PUBLIC ${PLACEGRAPH_EIGEN_ALIGNMENT})
  target_link_libraries(${target} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  placegraph_compile_options(${target})
  if(ARG_ACROSS_FOLDERS)
    placegraph_unity(${target} ACROSS_FOLDERS)
  else()
    placegraph_unity(${target})
  endif()
  if(ARG_PRECOMPILE)
    target_precompile_headers(${target} PRIVATE ${ARG_PRECOMPILE})
  elseif(ARG_PRECOMPILED_BY)
    target_precompile_headers(${target} REUSE_FROM placegraph_${ARG_PRECOMPILED_BY})
  endif()
  if(NOT ARG_INTERNAL)
    set_property(GLOBAL APPEND PROPERTY PLACEGRAPH_LIBRARIES ${target})
  endif()
endfunction()

# placegraph_elements(sources...): sources of this folder that belong to the library placegraph_elements, which
# cmake/elements.cmake makes. No other library calls them (tests/lint/core_alone.py).
function(placegraph_elements)
  file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  list(TRANSFORM ARGN PREPEND ${folder}/)
  set_property(GLOBAL APPEND PROPERTY PLACEGRAPH_ELEMENTS_SOURCES ${ARGN})
endfunction()
