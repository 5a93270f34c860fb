include(CMakePackageConfigHelpers)

# Programs name the libraries they need (placegraph::graph, placegraph::slam ...), whether these are static or all
# one shared library.
if(BUILD_SHARED_LIBS)
  set(installed placegraph_all)
  foreach(library IN LISTS PLACEGRAPH_STATIC_LIBRARIES)
    get_target_property(name ${library} EXPORT_NAME)
    add_library(${library}_shared INTERFACE)
    set_target_properties(${library}_shared PROPERTIES EXPORT_NAME ${name})
    target_link_libraries(${library}_shared INTERFACE placegraph_all)
    list(APPEND installed ${library}_shared)
  endforeach()
else()
  set(installed ${PLACEGRAPH_STATIC_LIBRARIES} placegraph_all)
  list(REMOVE_ITEM installed placegraph_graph placegraph_backend)
  install(TARGETS placegraph_graph placegraph_backend EXPORT placegraphBackendTargets)
  install(EXPORT placegraphBackendTargets NAMESPACE placegraph:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/placegraph)
endif()
install(TARGETS ${installed} EXPORT placegraphTargets)
install(EXPORT placegraphTargets NAMESPACE placegraph:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/placegraph)
if(PLACEGRAPH_APPS)
  install(TARGETS placegraph_cli)
endif()
install(TARGETS placegraph_opencv_plugin LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/placegraph)
install(DIRECTORY configs/models DESTINATION ${CMAKE_INSTALL_DATADIR}/placegraph)
foreach(folder graph frontend backend io eval pipeline)
  install(DIRECTORY ${folder} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/placegraph
    FILES_MATCHING PATTERN "*.h" PATTERN internal EXCLUDE PATTERN placegraph.h EXCLUDE)
endforeach()
install(FILES pipeline/placegraph.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/placegraph)
set(PLACEGRAPH_PLUGIN_DIR ${CMAKE_INSTALL_LIBDIR}/placegraph)
configure_package_config_file(cmake/placegraphConfig.cmake.in ${PROJECT_BINARY_DIR}/placegraphConfig.cmake
  PATH_VARS PLACEGRAPH_PLUGIN_DIR
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/placegraph)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/placegraphConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/placegraphConfig.cmake ${PROJECT_BINARY_DIR}/placegraphConfigVersion.cmake
    cmake/FindCAMD.cmake cmake/FindCHOLMOD.cmake cmake/FindGeographicLib.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/placegraph)
