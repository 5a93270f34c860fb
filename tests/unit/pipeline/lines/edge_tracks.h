#pragma once
#include <placegraph/backend/window/sliding_window.h>
#include <placegraph/frontend/lines/line_tracker.h>
#include <placegraph/graph/core/ids.h>

#include <vector>

namespace placegraph::test {

/// A camera of 640 x 480 pixels without distortion.
inline Camera line_camera() {
  Camera camera;
  camera.width = 640, camera.height = 480;
  camera.fx = camera.fy = 500;
  camera.cx = 320, camera.cy = 240;
  return camera;
}

inline Eigen::Vector2d project(const SE3& T_odom_cam, const Eigen::Vector3d& point_odom) {
  return *line_camera().project(T_odom_cam.inverse() * point_odom);
}

inline Line3 line_through(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return Line3::from_direction(a, b - a);
}

/// The track of the straight edge between two points of the odometry frame.
inline LineTrack track_of(LineId id, const SE3& T_odom_cam, const Eigen::Vector3d& start_odom,
                          const Eigen::Vector3d& end_odom) {
  LineTrack track;
  track.id = id;
  track.edge.segment = {project(T_odom_cam, start_odom), project(T_odom_cam, end_odom)};
  const Eigen::Vector2d a = track.edge.segment.start, b = track.edge.segment.end;
  track.edge.line = *fit_line({a, 0.5 * (a + b), b}, {0.1, 0.1, 0.1});
  return track;
}

}  // namespace placegraph::test
