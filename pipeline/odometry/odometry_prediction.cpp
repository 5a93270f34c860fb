#include <placegraph/graph/core/median.h>
#include <placegraph/pipeline/cues/nearest_depth.h>
#include <placegraph/pipeline/odometry/odometry.h>

namespace placegraph {
/// Where the tracks are seen from `T_odom_cam`: landmarks where they are, other points as deep as
/// the landmarks beside them.
std::vector<Eigen::Vector2f> Odometry::predict(const SE3& T_odom_cam) const {
  const SE3 T_cam_odom = T_odom_cam.inverse(), T_last_odom = T_odom_last_.inverse();
  const Camera& camera = calibration_.camera;
  const auto& tracks = tracker_.tracks();
  std::vector<std::optional<Eigen::Vector3d>> points;
  std::vector<KnownDepth> known;
  for (const PointTrack& track : tracks) {
    points.push_back(window_.landmark(track.id));
    if (!points.back()) continue;
    const double depth = (T_last_odom * *points.back()).z();
    if (depth > 0) known.push_back({track.px, depth});
  }
  std::vector<Eigen::Vector2f> predicted;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    predicted.push_back(tracks[i].px);
    if (!points[i]) {
      const auto ray = camera.unproject(tracks[i].px.cast<double>());
      if (!ray) continue;
      const double depth = depth_nearby(known, tracks[i].px, median_depth_m_);
      points[i] = T_odom_last_ * Eigen::Vector3d(depth * *ray);
    }
    const auto px = camera.project(T_cam_odom * *points[i]);
    if (px && camera.contains(*px, 2)) predicted.back() = px->cast<float>();
  }
  return predicted;
}

/// Follows the points and poses the frame by them. Where the last frame's were near to where the
/// velocity had them, these are sought nearby; where half of the landmarks are not found again so,
/// the camera has jerked: all around.
Pose3d2dResult Odometry::follow_points(const Frame& frame, const SE3& prior, Random& random,
                                       std::vector<bool>& keep) {
  constexpr double kEnough = 0.5, kNear_px = 4;
  if (!cues_.points) return pose_from_points(prior, random, keep);
  const auto predicted = predict(prior);
  const auto follow = [&](PointTracker::Search search) {
    const auto span = times_.measure("point tracking");
    std::map<std::int64_t, Eigen::Vector2f> expected;
    for (std::size_t i = 0; i < predicted.size(); ++i)
      expected[tracker_.tracks()[i].id] = predicted[i];
    tracker_.track(frame.image, predicted, search);
    std::vector<double> errors_px;
    for (const PointTrack& track : tracker_.tracks())
      errors_px.push_back((track.px - expected.at(track.id)).norm());
    prediction_error_px_ = errors_px.empty() ? kNear_px : median_of(errors_px);
    return pose_from_points(prior, random, keep);
  };
  if (velocity_known_ && prediction_error_px_ < kNear_px) {
    const PointTracker before = tracker_;
    double landmarks = 0;
    for (const PointTrack& track : before.tracks())
      landmarks += window_.landmark(track.id).has_value();
    const Pose3d2dResult pose = follow(PointTracker::Search::kNear);
    if (pose.outcome && static_cast<double>(pose.inliers.size()) > kEnough * landmarks) return pose;
    tracker_ = before;
  }
  return follow(PointTracker::Search::kWide);
}

}  // namespace placegraph
