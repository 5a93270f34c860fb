# Headers are included as <placegraph/folder/file.h>, in the source tree as after installation: the
# build tree gets a folder `placegraph` whose entries point at the source folders.
set(PLACEGRAPH_INCLUDE_DIR ${CMAKE_BINARY_DIR}/include)
file(MAKE_DIRECTORY ${PLACEGRAPH_INCLUDE_DIR}/placegraph)
foreach(folder graph frontend backend io eval pipeline)
  file(CREATE_LINK ${PROJECT_SOURCE_DIR}/${folder} ${PLACEGRAPH_INCLUDE_DIR}/placegraph/${folder} SYMBOLIC)
endforeach()

# GCC takes fixed-size Eigen decompositions for uninitialized wherever it inlines them.
function(placegraph_compile_options target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wshadow -Wnon-virtual-dtor
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized> $<$<BOOL:${PLACEGRAPH_WERROR}>:-Werror>)
endfunction()

# placegraph_unity(target [size]): sources of one folder are compiled together, `size` (8) at a time, because
# half of compiling a source is reading headers and instantiating Eigen's templates. File-local names are
# unique within a folder for that reason. PLACEGRAPH_UNITY=OFF compiles each by itself, which is quicker
# where a source is changed again and again.
function(placegraph_unity target)
  if(NOT PLACEGRAPH_UNITY)
    return()
  endif()
  set(size 8)
  if(ARGC GREATER 1)
    set(size ${ARGV1})
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  # Files compiled together see each other's using-declarations, which their variables then "shadow".
  target_compile_options(${target} PRIVATE -Wno-shadow)
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    cmake_path(GET source PARENT_PATH folder)
    if(IS_ABSOLUTE "${source}")
      continue()  # generated
    endif()
    string(MAKE_C_IDENTIFIER "${folder}" group)
    math(EXPR count_${group} "${count_${group}} + 1")
    math(EXPR part "(${count_${group}} - 1) / ${size}")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group}_${part})
  endforeach()
endfunction()

# placegraph_library(name SOURCES ... [PUBLIC targets] [PRIVATE targets] [PRECOMPILE headers])
# makes placegraph_<name>, alias placegraph::<name>.
function(placegraph_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE;PRECOMPILE" ${ARGN})
  set(target placegraph_${name})
  add_library(${target} ${ARG_SOURCES})
  add_library(placegraph::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} VERSION ${PROJECT_VERSION} SOVERSION 0)
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${PLACEGRAPH_INCLUDE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_link_libraries(${target} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  placegraph_compile_options(${target})
  placegraph_unity(${target})
  if(ARG_PRECOMPILE)
    target_precompile_headers(${target} PRIVATE ${ARG_PRECOMPILE})
  endif()
  set_property(GLOBAL APPEND PROPERTY PLACEGRAPH_LIBRARIES ${target})
endfunction()
