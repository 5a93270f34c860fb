#pragma once
#include <placegraph/frontend/markers/square_fit.h>
#include <placegraph/graph/core/error.h>

#include <fstream>
#include <map>
#include <numbers>
#include <string>

#include "tests/support/pictures.h"

namespace placegraph::test {

/// A tag of the simulated picture, in this project's frames.
struct SimulatedTag {
  double side_m = 0;
  SquareCorners corners_px;
  SE3 T_cam_marker;
};
struct SimulatedTags {
  Image image;
  Camera camera;
  std::map<int, SimulatedTag> tags;
};

/// Reads apriltag_sim as its README describes it. Its pixels have their centres at halves (the
/// boundary of the floor's squares under the optical axis, cx = 320, lies between columns 319 and
/// 320), ours at integers; its tags are read turned by half a turn against OpenCV's dictionary, and
/// their corners begin at the bottom left.
inline SimulatedTags read_apriltag_sim(const std::string& folder) {
  SimulatedTags result;
  result.image = test::read_grey_picture(folder + "/tag36_11_640x480.png");
  require(!result.image.empty(), "no picture in " + folder);
  Camera& camera = result.camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = camera.fy = 700;
  camera.cx = 320 - 0.5;
  camera.cy = 240 - 0.5;
  std::ifstream corners(folder + "/corners_tag36_11.txt");
  const SE3 half_turn(SO3::exp({0, 0, std::numbers::pi}), Eigen::Vector3d::Zero());
  constexpr int kTheirs[4] = {1, 0, 3, 2};  // of our corner k
  for (int id = 0; corners >> id;) {
    SquareCorners theirs;
    for (Eigen::Vector2d& corner : theirs) corners >> corner.x() >> corner.y();
    std::ifstream pose(folder + "/cMo_" + std::to_string(id) + ".txt");
    Eigen::Matrix4d T;
    for (int i = 0; i < 16; ++i) pose >> T(i / 4, i % 4);
    require(corners && pose, "apriltag_sim: truncated");
    SimulatedTag tag;
    tag.side_m = id < 3 ? 0.2 : 0.1;
    tag.T_cam_marker =
        SE3(Eigen::Matrix3d(T.topLeftCorner<3, 3>()), Eigen::Vector3d(T.topRightCorner<3, 1>())) *
        half_turn;
    for (int k = 0; k < 4; ++k) tag.corners_px[k] = theirs[kTheirs[k]] - Eigen::Vector2d(0.5, 0.5);
    result.tags[id] = tag;
  }
  return result;
}

inline double worst_corner_px(const SquareCorners& a, const SquareCorners& b) {
  double worst = 0;
  for (int k = 0; k < 4; ++k) worst = std::max(worst, (a[k] - b[k]).norm());
  return worst;
}

}  // namespace placegraph::test
