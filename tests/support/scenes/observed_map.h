#pragma once
#include "tests/support/scenes/posed_map.h"
#include "tests/support/scenes/scene.h"

namespace placegraph::test {

/// A map in metres of the cameras of a scene, which observe its points; landmark i is point i, with
/// a standard deviation of 0.02 m in every direction, and belongs to keyframe 0.
inline Map observed_map(const PointScene& scene) {
  Map map = posed_map(scene.T_ref_cam);
  for (std::size_t i = 0; i < scene.points_ref.size(); ++i) {
    PointLandmark& landmark = map.landmarks.emplace_back();
    landmark.id = LandmarkId(static_cast<std::int64_t>(i));
    landmark.keyframe = KeyframeId(0);
    landmark.point_cam = scene.T_ref_cam[0].inverse() * scene.points_ref[i];
    landmark.observations = static_cast<int>(scene.T_ref_cam.size());
    landmark.covariance = Eigen::Vector3d::Constant(0.02 * 0.02).asDiagonal();
    landmark.rgb = {static_cast<std::uint8_t>(i % 256), 7, 255};
    for (std::size_t view = 0; view < scene.px.size(); ++view)
      map.keyframes[view].observations.push_back({landmark.id, scene.px[view][i].cast<float>()});
  }
  for (const Keyframe& keyframe : map.keyframes) {
    FrameRecord& frame = map.frames.emplace_back();
    frame.frame = keyframe.frame;
    frame.stamp_ns = keyframe.stamp_ns;
    frame.keyframe = keyframe.id;
    frame.T_keyframe_frame = SE3();
    map.trajectory_online.poses.push_back(
        {keyframe.stamp_ns, rigid_part(map.S_map_keyframe(keyframe.id)).isometry()});
  }
  return map;
}

/// Poses of a camera that moves to the right in steps of half a metre and looks ahead.
inline std::vector<SE3> sideways(int count) {
  std::vector<SE3> poses;
  for (int i = 0; i < count; ++i)
    poses.push_back(SE3::exp((Vector6d() << 0.5 * i, 0.02 * i, 0, 0, -0.02 * i, 0).finished()));
  return poses;
}

}  // namespace placegraph::test
