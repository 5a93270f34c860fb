#include <placegraph/pipeline/odometry/odometry.h>

#include <opencv2/core.hpp>

// What surfaces and surroundings say about where motion is to be seen.

namespace placegraph {

void Odometry::set_scene(std::shared_ptr<const SceneEye> eye, bool masks) {
  eye_ = std::move(eye);
  masks_ = masks;
}

void Odometry::assume(const std::optional<Assumptions>& assumptions) {
  assumed_ = assumptions;
  if (assumed_ && assumed_->manhattan_world && !manhattan_ && cues_.points)
    manhattan_.emplace(options_.manhattan, calibration_.camera, seed_, log_);
}

/// A keyframe, or what may become one, with what its labels say is not to be used.
Frame Odometry::looked_at(const Frame& frame) {
  if (!eye_) return frame;
  if (!sight_ || sight_->frame != frame.id) {
    const auto span = times_.measure("scene labels");
    const bool trusted = !assumed_ || assumed_->street_surfaces;
    sight_ = std::make_shared<const SceneSight>(eye_->look(frame, masks_ && trusted));
  }
  Frame seen = frame;
  const Image& use = sight_->masks.use;
  if (use.empty()) return seen;
  if (frame.mask.empty())
    seen.mask = use;
  else
    cv::bitwise_and(frame.mask, use, seen.mask);
  return seen;
}

/// New points where the frame's mask allows them; anywhere, if those are too few to go on with.
void Odometry::detect_points(const Frame& frame, const Image& given_mask) {
  tracker_.detect(frame.mask);
  const bool masked = sight_ && !sight_->masks.use.empty();
  if (masked && static_cast<int>(tracker_.tracks().size()) < options_.min_unmasked_tracks)
    tracker_.detect(given_mask);
}

/// Drops tracks that have come to lie on what may move, as long as enough are left.
void Odometry::leave_moving_things() {
  if (!sight_ || sight_->masks.still.empty()) return;
  const Image& still = sight_->masks.still;
  std::vector<bool> keep;
  int kept = 0;
  for (const PointTrack& track : tracker_.tracks()) {
    const int u = std::clamp(static_cast<int>(std::lround(track.px.x())), 0, still.cols - 1);
    const int v = std::clamp(static_cast<int>(std::lround(track.px.y())), 0, still.rows - 1);
    keep.push_back(still.at<std::uint8_t>(v, u) != 0);
    kept += keep.back();
  }
  if (kept >= options_.min_unmasked_tracks) tracker_.keep(keep);
}

/// 0 where labels of surfaces tell that the frame shows no ground; empty where they tell nothing.
Image Odometry::labelled_ground(const Frame& frame) const {
  if (!sight_ || sight_->frame != frame.id) return {};
  return sight_->masks.ground;
}

/// Whether rectangular worlds are among the cues, and assumed to be there.
bool Odometry::sees_worlds() const {
  return manhattan_ && (!assumed_ || assumed_->manhattan_world);
}

/// What labels of surfaces and the edges of the last keyframe, this frame, tell of the ground.
GroundSight Odometry::ground_sight(const Frame& frame) const {
  GroundSight ground;
  if (sees_worlds()) ground = manhattan_->ground(ground_->outline_px());
  if (ground.level && !ground_->may_be_ground(*ground.level)) ground = {};
  const Image labelled = labelled_ground(frame);
  if (ground.mask.empty())
    ground.mask = labelled;
  else if (!labelled.empty())
    ground.mask = ground.mask & labelled;
  return ground;
}

std::vector<Eigen::Vector3d> Odometry::points_cam() const {
  std::vector<Eigen::Vector3d> points;
  const SE3 T_cam_odom = T_odom_last_.inverse();
  for (const PointTrack& track : tracker_.tracks())
    if (const auto point = window_.landmark(track.id)) points.push_back(T_cam_odom * *point);
  return points;
}

}  // namespace placegraph
