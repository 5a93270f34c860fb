# The elements of visual navigation that no run, no evaluation and no optimization of graphs needs: markers and flying
# robots, planes of point clouds, regions that are aligned, dense flow, floor plans and street maps of finished
# maps, classifiers and codes of places. Their sources stand beside those of the core, which never calls them.
get_property(elements GLOBAL PROPERTY PLACEGRAPH_ELEMENTS_SOURCES)
placegraph_library(elements
  SOURCES ${elements} ${PROJECT_BINARY_DIR}/frontend/built_in_planarity.cpp
  PUBLIC placegraph::pipeline placegraph::report placegraph::eval
  PRIVATE opencv_aruco opencv_video opencv_features2d opencv_calib3d opencv_ml opencv_line_descriptor opengv
    nlohmann_json::nlohmann_json fmt::fmt Threads::Threads
  PRECOMPILED_BY frontend)
set_source_files_properties(frontend/align/alignment_covariance.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
