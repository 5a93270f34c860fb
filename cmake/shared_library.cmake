# What a user links: placegraph::placegraph, the whole of it. With BUILD_SHARED_LIBS it is one shared library
# that shows what the public headers declare (their namespace has default visibility, all else is hidden);
# otherwise it stands for the static libraries. The program and the tests link the static ones either way: tests
# reach what is hidden.
get_property(PLACEGRAPH_STATIC_LIBRARIES GLOBAL PROPERTY PLACEGRAPH_LIBRARIES)
if(BUILD_SHARED_LIBS)
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/shared_library.cpp CONTENT "// All of it comes from the static libraries.\n")
  add_library(placegraph_all SHARED ${PROJECT_BINARY_DIR}/shared_library.cpp)
  set_target_properties(placegraph_all PROPERTIES OUTPUT_NAME placegraph VERSION ${PROJECT_VERSION}
    SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR} LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib)
  set(whole ${PLACEGRAPH_STATIC_LIBRARIES})
  list(REMOVE_ITEM whole placegraph_pipeline)
  list(JOIN whole "," whole)
  set_property(TARGET placegraph_all PROPERTY LINK_LIBRARY_OVERRIDE "WHOLE_ARCHIVE,${whole}")
  target_link_libraries(placegraph_all PUBLIC Eigen3::Eigen opencv_core PRIVATE ${PLACEGRAPH_STATIC_LIBRARIES})
  # FAISS comes as a static library whose symbols are visible: another one in the same program must not meet it.
  target_link_options(placegraph_all PRIVATE -Wl,--exclude-libs,libfaiss.a)
  target_include_directories(placegraph_all PUBLIC
    $<BUILD_INTERFACE:${PLACEGRAPH_INCLUDE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_compile_features(placegraph_all PUBLIC cxx_std_20)
  target_compile_definitions(placegraph_all PUBLIC ${PLACEGRAPH_EIGEN_ALIGNMENT})
else()
  add_library(placegraph_all INTERFACE)
  target_link_libraries(placegraph_all INTERFACE ${PLACEGRAPH_STATIC_LIBRARIES})
endif()
add_library(placegraph::placegraph ALIAS placegraph_all)
set_target_properties(placegraph_all PROPERTIES EXPORT_NAME placegraph)
