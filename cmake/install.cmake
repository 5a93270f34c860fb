include(CMakePackageConfigHelpers)

get_property(libraries GLOBAL PROPERTY PLACEGRAPH_LIBRARIES)
add_library(placegraph_all INTERFACE)
add_library(placegraph::placegraph ALIAS placegraph_all)
set_target_properties(placegraph_all PROPERTIES EXPORT_NAME placegraph)
target_link_libraries(placegraph_all INTERFACE ${libraries})

install(TARGETS ${libraries} placegraph_all EXPORT placegraphTargets)
install(EXPORT placegraphTargets NAMESPACE placegraph:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/placegraph)
install(TARGETS placegraph_cli)
install(TARGETS placegraph_opencv_plugin LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/placegraph)
install(DIRECTORY configs/models DESTINATION ${CMAKE_INSTALL_DATADIR}/placegraph)
foreach(folder graph frontend backend io eval pipeline)
  install(DIRECTORY ${folder} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/placegraph FILES_MATCHING PATTERN "*.h")
endforeach()
set(PLACEGRAPH_PLUGIN_DIR ${CMAKE_INSTALL_LIBDIR}/placegraph)
configure_package_config_file(cmake/placegraphConfig.cmake.in ${CMAKE_BINARY_DIR}/placegraphConfig.cmake
  PATH_VARS PLACEGRAPH_PLUGIN_DIR
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/placegraph)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/placegraphConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/placegraphConfig.cmake ${CMAKE_BINARY_DIR}/placegraphConfigVersion.cmake
    cmake/FindCAMD.cmake cmake/FindCHOLMOD.cmake cmake/FindGeographicLib.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/placegraph)
