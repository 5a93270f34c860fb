#pragma once
#include <placegraph/graph/image/frame.h>

#include <functional>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "tests/support/scenes/scene.h"
#include "tests/support/scenes/texture.h"

namespace placegraph::test {

/// A corridor along z with plain boards on its walls, its floor and its end. World: x right, y
/// down, z forward; all edges run along these axes, and there is no texture beside them. The floor
/// lies kBoardsHeight_m below the origin.
inline constexpr double kBoardsHeight_m = 1.4;

inline std::vector<TexturedPlane> boards() {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(),
                        z = Eigen::Vector3d::UnitZ();
  std::vector<TexturedPlane> planes;
  const auto add = [&](const Eigen::Vector3d& right, const Eigen::Vector3d& down,
                       const Eigen::Vector3d& middle, double half_right_m, double half_down_m,
                       double grey) {
    Eigen::Matrix3d R;
    R << right, down, right.cross(down);
    planes.push_back(
        {SE3(R, middle), half_right_m, half_down_m, {.octaves = 0, .contrast = 0, .mean = grey}});
  };
  constexpr double kWall_m = 2, kCeiling_m = -1.3, kEnd_m = 11, kLift_m = 0.01;
  add(x, z, {0, kBoardsHeight_m, 5}, 10, 20, 70);
  add(x, z, {0, kCeiling_m, 5}, 10, 20, 150);
  add(z, y, {-kWall_m, 0, 5}, 20, 5, 95);
  add(z, y, {kWall_m, 0, 5}, 20, 5, 120);
  add(x, y, {0, 0, kEnd_m}, 5, 5, 105);
  const double along[] = {2.6, 3.7, 5.1, 6.4, 8.2};
  for (int i = 0; i < 5; ++i) {
    const double bright = i % 2 == 0 ? 215 : 25, dark = i % 2 == 0 ? 30 : 200;
    add(z, y, {-kWall_m + kLift_m, -0.2 + 0.1 * i, along[i]}, 0.35 + 0.03 * i, 0.5, bright);
    add(z, y, {kWall_m - kLift_m, 0.2 - 0.1 * i, along[i] + 0.4}, 0.3 + 0.04 * i, 0.45, dark);
    add(x, z, {0.5 - 0.25 * i, kBoardsHeight_m - kLift_m, along[i] + 0.6}, 0.6, 0.25, bright);
  }
  add(x, y, {-0.9, 0.2, kEnd_m - kLift_m}, 0.4, 0.6, 220);
  add(x, y, {0.8, -0.3, kEnd_m - kLift_m}, 0.5, 0.4, 20);
  // Two that stand across the corridor, before the walls.
  add(x, y, {-1.6, 0.4, 4.4}, 0.25, 0.6, 170);
  add(x, y, {1.6, 0.1, 5.8}, 0.3, 0.7, 50);
  return planes;
}

inline Camera boards_camera() { return pinhole(480, 320, 340); }

/// Seen with every pixel the mean of four, so that edges are where they are to a part of a pixel.
inline Image boards_image(const SE3& T_world_cam) {
  Camera fine = boards_camera();
  fine.width *= 2, fine.height *= 2;
  fine.fx *= 2, fine.fy *= 2;
  fine.cx = 2 * fine.cx + 0.5, fine.cy = 2 * fine.cy + 0.5;  // of four pixels the middle
  Image half;
  cv::resize(render(fine, T_world_cam, boards()).grey, half, {fine.width / 2, fine.height / 2}, 0,
             0, cv::INTER_AREA);
  return half;
}

/// Frames 0, 1, ... on a way through the corridor; with a right image if baseline_m > 0.
inline std::vector<Frame> boards_frames(int count, const std::function<SE3(int)>& T_world_cam,
                                        double baseline_m = 0) {
  std::vector<Frame> frames;
  for (int i = 0; i < count; ++i) {
    Frame frame;
    frame.id = FrameId(i);
    frame.stamp_ns = 100'000'000L * i;
    frame.image = boards_image(T_world_cam(i));
    if (baseline_m > 0)
      frame.right = boards_image(T_world_cam(i) * pose({0, 0, 0}, {baseline_m, 0, 0}));
    frames.push_back(frame);
  }
  return frames;
}

}  // namespace placegraph::test
