#include <placegraph/frontend/relative_pose/pose_3d2d.h>
#include <placegraph/pipeline/odometry/odometry.h>

namespace placegraph {

void Odometry::remember(std::int64_t frame, const std::optional<ManhattanCue::Heading>& heading) {
  FrameBetween& between = between_.emplace_back();
  between.frame = frame;
  between.T_keyframe_cam = window_.pose(last_keyframe_).inverse() * T_odom_last_;
  between.heading = heading;
  for (const PointTrack& track : tracker_.tracks())
    if (window_.landmark(track.id)) between.px.emplace_back(track.id, track.px.cast<double>());
}

/// First looks tell at keyframes how far tracks have drifted since the last one: a little with
/// every frame, which the frames between learn of here.
void Odometry::anchor_tracks() {
  std::map<std::int64_t, Eigen::Vector2d> before, drift;
  for (const PointTrack& track : tracker_.tracks()) before[track.id] = track.px.cast<double>();
  tracker_.anchor();
  for (const PointTrack& track : tracker_.tracks())
    drift[track.id] = track.px.cast<double>() - before.at(track.id);
  const double steps = static_cast<double>(between_.size()) + 1;
  for (std::size_t k = 0; k < between_.size(); ++k)
    for (auto& [id, px] : between_[k].px)
      if (const auto d = drift.find(id); d != drift.end())
        px += static_cast<double>(k + 1) / steps * d->second;
}

/// A frame was posed against landmarks as `keyframe` and its predecessors knew them, as if they
/// were exact. One more keyframe has moved those whose depth was poorly known: the frame's pose
/// follows, or the way between two keyframes would be a false pace and a jump.
void Odometry::pose_between(std::int64_t keyframe, OdometryUpdate& update) {
  constexpr int kIterations = 10;
  constexpr double kSigmaPx = 1;  // of a track
  for (const FrameBetween& between : between_) {
    std::vector<Eigen::Vector3d> points;
    std::vector<Eigen::Vector2d> px;
    std::vector<int> all;
    for (const auto& [id, pixel] : between.px)
      if (const auto point = window_.landmark(id)) {
        all.push_back(static_cast<int>(points.size()));
        points.push_back(*point);
        px.push_back(pixel);
      }
    if (static_cast<int>(points.size()) < options_.pose.ransac.min_inliers) continue;
    SE3 T_keyframe_cam = between.T_keyframe_cam;
    if (update.rescale) T_keyframe_cam = T_keyframe_cam.scaled(update.rescale->factor);
    Matrix6d normal;
    const SE3 by_points = refine_pose_3d2d(calibration_.camera, points, px, all,
                                           window_.pose(keyframe) * T_keyframe_cam,
                                           options_.pose.threshold_px, kIterations, &normal);
    const SE3 T_odom_cam = turned(by_points, normal / (kSigmaPx * kSigmaPx), between.heading);
    if (T_odom_cam.matrix().allFinite()) update.filled.emplace_back(between.frame, T_odom_cam);
  }
  between_.clear();
}

}  // namespace placegraph
