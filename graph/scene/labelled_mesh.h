#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

namespace placegraph {

/// Ground truth of a static scene: polygons, each with a class.
struct LabelledMesh {
  struct Face {
    std::vector<int> corners;  ///< three or more indices, convex and planar
    int label = 0;             ///< position in `classes`
  };
  std::vector<std::string> classes;
  std::vector<Eigen::Vector3d> vertices;  ///< world frame [m]
  std::vector<Face> faces;
};

}  // namespace placegraph
