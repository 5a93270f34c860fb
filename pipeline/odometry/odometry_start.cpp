#include <fmt/format.h>
#include <placegraph/graph/core/median.h>
#include <placegraph/pipeline/odometry/odometry.h>

namespace placegraph {

/// What a first keyframe by two eyes or by depth lacks.
std::string Odometry::too_few_landmarks() const {
  return fmt::format(
      "{} of {} tracked points {}, {} needed to begin", landmarks_in_window(),
      tracker_.tracks().size(),
      calibration_.baseline_m > 0 ? "found in the right eye's image" : "with a measured depth",
      options_.pose.ransac.min_inliers);
}

OdometryUpdate Odometry::begin(const Frame& frame) {
  if (cues_.surfaces_alone()) return begin_on_surfaces(frame);
  started_ = true;
  if (cues_.points) tracker_.track(frame.image);
  OdometryUpdate update;
  if (scale_known_) {  // stereo and RGB-D have their landmarks at once
    add_keyframe(frame, T_odom_start_, update);
    if (landmarks_in_window() < options_.pose.ransac.min_inliers) {
      update.reason = too_few_landmarks();
      update.new_keyframes.clear();
      next_keyframe_ = last_keyframe_;
      // Nothing came of it: neither the keyframe nor its few landmarks belong to the map.
      std::vector<PointLandmark> past = std::move(past_landmarks_);
      restart(T_odom_start_, in_known_map_);
      past_landmarks_ = std::move(past);
      return update;
    }
    state_ = update.state = TrackingState::kTracking;
    update.T_odom_cam = T_odom_last_ = window_.pose(last_keyframe_);
    update.keyframe = last_keyframe_;
    return update;
  }
  if (!cues_.points) return begin_with_lines(frame);
  const Frame seen = looked_at(frame);
  detect_points(seen, frame.mask);
  if (static_cast<int>(tracker_.tracks().size()) < 2 * options_.initializer.min_points) {
    update.reason = fmt::format("{} points to track, {} needed to begin", tracker_.tracks().size(),
                                2 * options_.initializer.min_points);
    started_ = false;  // a dark or empty frame is nothing to begin with
    tracker_.reset();
    return update;
  }
  update.reference = true;
  update.T_odom_cam = T_odom_start_;
  reference_frame_ = seen;
  reference_sight_ = sight_;
  views_.clear();
  View view{frame.id, {}};
  for (const PointTrack& track : tracker_.tracks()) view.px[track.id] = track.px.cast<double>();
  views_.push_back(std::move(view));
  return update;
}

/// The frames between keyframes `ref` and `cur` get their poses from the points.
void Odometry::fill_between(std::int64_t ref, std::int64_t cur, Random& random,
                            OdometryUpdate& update) const {
  for (std::size_t v = 1; v + 1 < views_.size(); ++v) {
    std::vector<Eigen::Vector3d> points;
    std::vector<Eigen::Vector2d> px;
    for (const auto& [id, pixel] : views_[v].px)
      if (const auto point = window_.landmark(id)) {
        points.push_back(*point);
        px.push_back(pixel);
      }
    const double share = static_cast<double>(v) / (views_.size() - 1);
    const SE3 prior = window_.pose(ref) *
                      SE3::exp(share * (window_.pose(ref).inverse() * window_.pose(cur)).log());
    const auto pose =
        estimate_pose_3d2d(calibration_.camera, points, px, options_.pose, random, &prior);
    if (pose.outcome) update.filled.emplace_back(views_[v].frame, pose.T_ref_cam);
  }
}

OdometryUpdate Odometry::try_initialize(const Frame& frame, const std::optional<SE3>& T_known) {
  if (!cues_.points) return try_lines(frame, T_known);
  OdometryUpdate update;
  View view{frame.id, {}};
  std::vector<std::int64_t> ids;
  std::map<std::int64_t, int> index;
  std::vector<Eigen::Vector2d> px_ref, px_cur;
  for (const PointTrack& track : tracker_.tracks()) {
    view.px[track.id] = track.px.cast<double>();
    index[track.id] = static_cast<int>(ids.size());
    ids.push_back(track.id);
    px_ref.push_back(views_.front().px.at(track.id));
    px_cur.push_back(track.px.cast<double>());
  }
  views_.push_back(view);
  Random random(seed_, frame.id);
  if (static_cast<int>(ids.size()) < 2 * options_.initializer.min_points)
    return replace_reference(frame, T_known, turn_since(views_.front().px, random));
  std::vector<PartialView> between;
  // A few judges are enough, however long the camera stood still.
  constexpr std::size_t kJudges = 16;
  const std::size_t stride = views_.size() / kJudges + 1;
  for (std::size_t v = 1; v + 1 < views_.size(); v += stride) {
    between.emplace_back();
    for (const auto& [id, px] : views_[v].px)
      if (const auto i = index.find(id); i != index.end())
        between.back().emplace_back(i->second, px);
  }
  MonoInitialization start =
      initialize_mono(calibration_.camera, px_ref, px_cur, between, options_.initializer, random);
  if (start.outcome && turn_since(views_.front().px, random))
    start.outcome = Outcome::failure(Outcome::Code::kDegenerate, "a rotation explains the views");
  if (!start.outcome) {
    log(log_, LogLevel::kDebug, "initialization waits: {}", start.outcome.reason);
    update = wait_turning(frame, random);
    update.reason = start.outcome.reason;
    return update;
  }
  // The unit is arbitrary until the ground shows it.
  std::vector<double> depths;
  for (const auto& point : start.points_ref)
    if (point) depths.push_back(point->z());
  double scale = median_depth_m_ / median_of(depths);
  if (in_known_map_ && T_known) {
    scale = (T_known->translation() - T_odom_start_.translation()).norm();
  } else if (in_known_map_ && !ground_) {
    update.reason = "nothing gives the map's unit";
    log(log_, LogLevel::kDebug, "initialization waits: {}", update.reason);
    return update;
  }
  if (!(scale > 0)) return update;
  const Frame labelled = looked_at(frame);
  const SE3 T_ref_cur(start.T_ref_cur.rotation(), scale * start.T_ref_cur.translation());
  const std::int64_t ref = next_keyframe_++, cur = next_keyframe_++;
  window_.add_keyframe(ref, T_odom_start_);
  window_.add_keyframe(cur, T_odom_start_ * T_ref_cur);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const Eigen::Matrix2d covariance = tracker_.tracks()[i].covariance.cast<double>();
    sightings_[ids[i]] = {{ref, px_ref[i], covariance}, {cur, px_cur[i], covariance}};
    if (!start.points_ref[i]) continue;
    window_.add_landmark(ids[i], T_odom_start_ * (scale * *start.points_ref[i]));
    for (const Sighting2d& seen : sightings_[ids[i]]) add_observation(seen, ids[i], std::nullopt);
  }
  last_keyframe_ = cur;
  refine_window();
  if (ground_ || motion_) {
    if (ground_) keyframe_frames_[ref] = reference_frame_;
    stamps_[ref] = reference_frame_.stamp_ns;
    if (sees_worlds()) look_at_directions(labelled);
    measure_scale(labelled, update);
    update.rescale.reset();  // nobody has heard of these keyframes yet
    refine_window();
  }
  update.new_keyframes = {{ref, reference_frame_, reference_sight_}, {cur, labelled, sight_}};

  update.filled = std::move(turned_);  // what follows knows better
  turned_.clear();
  fill_between(ref, cur, random, update);
  const double steps = static_cast<double>(views_.size() - 1);
  views_.clear();
  detect_points(labelled, frame.mask);
  px_at_keyframe_.clear();
  for (const PointTrack& track : tracker_.tracks()) {
    px_at_keyframe_[track.id] = track.px.cast<double>();
    auto& seen = sightings_[track.id];
    if (seen.empty())
      seen.push_back({cur, track.px.cast<double>(), track.covariance.cast<double>()});
  }
  landmarks_at_keyframe_ = static_cast<int>(window_.landmarks().size());
  frames_since_keyframe_ = 0;
  T_odom_last_ = window_.pose(cur);
  T_last_cur_ = SE3::exp((window_.pose(ref).inverse() * T_odom_last_).log() / steps);
  velocity_known_ = true;
  state_ = update.state = TrackingState::kTracking;
  update.T_odom_cam = T_odom_last_;
  update.keyframe = cur;
  update.inliers = landmarks_at_keyframe_;
  return update;
}

}  // namespace placegraph
