#include <placegraph/pipeline/tracking/intermediate_frames.h>

#include <numeric>

namespace placegraph {

void IntermediateFrames::correct_drift(const std::map<LandmarkId, Eigen::Vector2d>& drift_px) {
  const double steps = static_cast<double>(frames_.size()) + 1;
  for (std::size_t k = 0; k < frames_.size(); ++k)
    for (auto& [id, px] : frames_[k].landmark_px)
      if (const auto drift = drift_px.find(id); drift != drift_px.end())
        px += static_cast<double>(k + 1) / steps * drift->second;
}

std::vector<std::pair<FrameId, SE3>> IntermediateFrames::repose(const LocalMap& map,
                                                                KeyframeId keyframe, double scale,
                                                                const RgbdErrors& errors) {
  // Iterations at most; they end at convergence. Chosen.
  constexpr int kIterations = 10;
  constexpr double kSigmaPx = 1;  // standard deviation of a track
  const SlidingWindow& window = map.window();
  std::vector<std::pair<FrameId, SE3>> posed;
  for (const Tracked& frame : frames_) {
    const SE3 T_odom_before = window.pose(keyframe) * frame.T_keyframe_cam.scaled(scale);
    const RgbdErrors change(errors.values() - frame.errors.errors.values());
    const auto corrected = [&](const Eigen::Vector2d& pixel, const Eigen::Vector3d& point) {
      const Eigen::Vector3d p_cam = T_odom_before.inverse() * point;
      if (!change.any() || !(p_cam.z() > 0)) return pixel;
      return Eigen::Vector2d(pixel -
                             change.displacement_px(camera_, pixel, p_cam, frame.errors.twist));
    };
    std::vector<Eigen::Vector3d> points;
    std::vector<Eigen::Vector2d> px;
    for (const auto& [id, pixel] : frame.landmark_px)
      if (const auto point = window.landmark(id)) {
        points.push_back(*point);
        px.push_back(corrected(pixel, *point));
      }
    if (static_cast<int>(points.size()) < options_.ransac.min_inliers) continue;
    std::vector<int> all(points.size());
    std::iota(all.begin(), all.end(), 0);
    Matrix6d normal;
    const SE3 by_points = refine_pose_3d2d(camera_, points, px, all, T_odom_before,
                                           options_.threshold_px, kIterations, &normal);
    const SE3 T_odom_cam = with_manhattan_rotation(by_points, normal / (kSigmaPx * kSigmaPx),
                                                   frame.manhattan_rotation, window);
    if (T_odom_cam.matrix().allFinite()) posed.emplace_back(frame.frame, T_odom_cam);
  }
  frames_.clear();
  return posed;
}

}  // namespace placegraph
