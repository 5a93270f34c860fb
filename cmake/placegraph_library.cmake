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

# placegraph_library(folder SOURCES ... [PUBLIC targets] [PRIVATE targets] [PRECOMPILE headers])
# makes placegraph_<folder>, alias placegraph::<folder>.
function(placegraph_library folder)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE;PRECOMPILE" ${ARGN})
  set(target placegraph_${folder})
  add_library(${target} ${ARG_SOURCES})
  add_library(placegraph::${folder} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${folder} VERSION ${PROJECT_VERSION} SOVERSION 0)
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${PLACEGRAPH_INCLUDE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_link_libraries(${target} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  placegraph_compile_options(${target})
  if(ARG_PRECOMPILE)
    target_precompile_headers(${target} PRIVATE ${ARG_PRECOMPILE})
  endif()
  set_property(GLOBAL APPEND PROPERTY PLACEGRAPH_LIBRARIES ${target})
endfunction()
