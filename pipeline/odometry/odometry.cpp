#include <placegraph/frontend/flow/flow_cues.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/median.h>
#include <placegraph/pipeline/odometry/odometry.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
Odometry::Odometry(const OdometryOptions& options, const Calibration& calibration,
                   std::uint64_t seed, LogSink log, StageTimes& times)
    : options_(options),
      calibration_(calibration),
      seed_(seed),
      log_(std::move(log)),
      times_(times),
      tracker_(options.tracker),
      window_(options.window, calibration.camera),
      cues_(parse_cues(options.cues)) {
  options_.check();
  calibration_.check();
  require(calibration.camera.distortion == Distortion::kNone,
          "calibration.camera: undistorted images needed (rectify them first)");
  scale_known_ = metric_from_start();
  require(!cues_.surfaces_alone() || scale_known_,
          "cues: surfaces without points need a right eye, depth or the camera's height");
  require(!cues_.direct || scale_known_ || calibration_.camera_height_m,
          "cues: direct needs a right eye, depth or the camera's height");
  if (cues_.lines) lines_.emplace(options_.lines, calibration_, options_.stereo);
  if (cues_.manhattan) manhattan_.emplace(options_.manhattan, calibration_.camera, seed_, log_);
  if (options_.planes.enabled && calibration_.depth && !cues_.surfaces_alone())
    planes_.emplace(options_.planes, log_);
  if (cues_.surfaces_alone() || cues_.direct)
    surfaces_.emplace(options_.surfaces, calibration_, options_.stereo, cues_.direct);
  if (!scale_known_ && calibration_.camera_height_m && options_.ground.enabled && cues_.plane)
    ground_.emplace(options_.ground, calibration_.camera, *calibration_.camera_height_m);
  if (!scale_known_ && lines_ && !cues_.points) lines_->use_compass();
  if (!scale_known_ && calibration_.camera_height_m && lines_ && !cues_.points && !ground_)
    floor_.emplace(options_.lines.floor, calibration_.camera, *calibration_.camera_height_m);
  if (calibration_.baseline_m > 0 && options_.rectification.enabled)
    rectification_.emplace(options_.rectification);
  window_ = empty_window();
}

SlidingWindow Odometry::empty_window() const {
  SlidingWindowOptions options = options_.window;
  if (ground_ || floor_ || motion_) options.scale_drift = options_.scale_drift;
  // A single eye's unit is handed on by where the window lies: it needs the prior's hold.
  if (metric_from_start()) options.hold_oldest = true;
  return SlidingWindow(options, calibration_.camera);
}

void Odometry::restart(const SE3& T_odom_cam, bool in_known_map,
                       const std::optional<double>& median_depth_m) {
  in_known_map_ = in_known_map;
  if (!in_known_map) median_depth_m_ = median_depth_m.value_or(kUnknownDepth);
  guesses_unit_ = !in_known_map && median_depth_m;
  landmarks_at_keyframe_ = frames_since_keyframe_ = 0;
  px_at_keyframe_.clear();
  past_landmarks_ = landmarks();
  tracker_.reset();
  if (lines_) lines_->reset();
  if (manhattan_) manhattan_->reset();
  if (planes_) planes_->reset();
  if (surfaces_) surfaces_->reset();
  newest_motion_ = DirectMotion();
  window_ = empty_window();
  state_ = TrackingState::kWaiting;
  started_ = lost_ = false;
  scale_known_ = metric_from_start();
  T_odom_restart_ = T_odom_start_ = T_odom_last_ = T_odom_cam;
  T_last_cur_ = SE3();
  velocity_known_ = false;
  first_keyframe_ = next_keyframe_;
  last_keyframe_ = -1;
  sightings_.clear();
  keyframe_frames_.clear();
  stamps_.clear();
  keyframe_poses_.clear();
  links_.clear();
  views_.clear();
  turned_.clear();
  line_views_.clear();
  if (floor_) floor_->reset();
  between_.clear();
}

OdometryUpdate Odometry::add_frame(const Frame& frame, const std::optional<SE3>& T_odom_cam_known) {
  if (!started_) return begin(frame);
  const PointTracker before = tracker_;
  const std::optional<LineCue> lines_before = lines_;
  const bool waiting = state_ == TrackingState::kWaiting;
  if (cues_.points && waiting) {
    const auto span = times_.measure("point tracking");
    tracker_.track(frame.image);
  }
  OdometryUpdate update = cues_.surfaces_alone() ? track_surfaces(frame)
                          : waiting              ? try_initialize(frame, T_odom_cam_known)
                                                 : track(frame);
  lost_ = update.state == TrackingState::kLost;
  if (lost_) {
    // The next frame may still be found from the last good one.
    tracker_ = before;
    lines_ = lines_before;
    T_last_cur_ = SE3();
    velocity_known_ = false;
  }
  return update;
}

OdometryUpdate Odometry::track(const Frame& frame) {
  const auto span = times_.measure("frame pose");
  OdometryUpdate update;
  Random random(seed_, frame.id);
  const SE3 prior = T_odom_last_ * T_last_cur_;
  std::vector<bool> keep;
  const Pose3d2dResult points = follow_points(frame, prior, random, keep);
  update.inliers = static_cast<int>(points.inliers.size());
  Outcome posed = points.outcome;
  SE3 T_odom_cam = points.T_ref_cam;
  Matrix6d information = points.information;
  if (lines_) {
    const PoseFromLines both = pose_with_lines(frame, prior, points, random);
    posed = both.outcome;
    T_odom_cam = both.T_ref_cam;
    information = both.information;
    update.inliers += static_cast<int>(both.inliers.size());
  }
  if (!posed) {
    log(log_, LogLevel::kInfo, "frame {} lost: {}", frame.id, posed.reason);
    update.state = TrackingState::kLost;
    update.reason = posed.reason;
    update.turn = turn_since(px_at_keyframe_, random);
    return update;
  }
  tracker_.keep(keep);
  const auto heading = heading_of(frame, T_odom_cam, update.inliers);
  T_odom_cam = turned(T_odom_cam, information, heading);

  T_last_cur_ = T_odom_last_.inverse() * T_odom_cam;
  velocity_known_ = true;
  T_odom_last_ = T_odom_cam;
  ++frames_since_keyframe_;
  if (keyframe_due(frame, update.inliers)) {
    add_keyframe(frame, T_odom_cam, update);
    T_odom_last_ = window_.pose(last_keyframe_);
    if (update.rescale) T_last_cur_ = T_last_cur_.scaled(update.rescale->factor);
  } else {
    remember(frame.id, heading);
  }
  update.state = TrackingState::kTracking;
  update.T_odom_cam = T_odom_last_;
  update.keyframe = last_keyframe_;
  return update;
}

bool Odometry::keyframe_due(const Frame& frame, int inliers) const {
  const KeyframeOptions& o = options_.keyframe;
  if (inliers < o.min_tracked_share * landmarks_at_keyframe_) return true;
  // Before too few are left to pose a frame by: other tracks become landmarks where there are some.
  const bool others = static_cast<int>(tracker_.tracks().size()) > inliers;
  if (cues_.points && others && inliers < 2 * options_.pose.ransac.min_inliers) return true;
  std::vector<double> flow_px;
  std::vector<FlowVector> flow;
  for (const PointTrack& track : tracker_.tracks()) {
    const auto at_keyframe = px_at_keyframe_.find(track.id);
    if (at_keyframe == px_at_keyframe_.end()) continue;
    const Eigen::Vector2d moved_px = track.px.cast<double>() - at_keyframe->second;
    if (!o.derotated) {
      flow_px.push_back(moved_px.norm());
      continue;
    }
    FlowVector& vector = flow.emplace_back();
    vector.kind = FlowVector::Kind::kFull;
    vector.px = at_keyframe->second;
    vector.flow = moved_px;
  }
  if (lines_ && !cues_.points)
    flow_px = lines_->flow_px();
  else if (o.derotated)
    for (const DerotatedFlow& vector :
         derotate(calibration_.camera, flow,
                  {(window_.pose(last_keyframe_).inverse() * T_odom_last_).rotation()}))
      flow_px.push_back(calibration_.camera.fx * vector.flow().norm());
  if (flow_px.size() < 10) return true;
  const double share = median_of(flow_px) / frame.image.cols;
  return share > o.max_flow_share ||
         (frames_since_keyframe_ >= o.max_interval && share > 0.1 * o.max_flow_share);
}

void Odometry::add_keyframe(const Frame& given, const SE3& T_odom_cam, OdometryUpdate& update) {
  const Frame frame = looked_at(given);
  const std::int64_t id = next_keyframe_++;
  window_.add_keyframe(id, T_odom_cam);
  if (cues_.points) {
    const auto span = times_.measure("point detection");
    anchor_tracks();
    leave_moving_things();
    detect_points(frame, given.mask);
  }
  observe_tracks(id, frame);
  if (lines_) observe_lines(id, frame);
  const std::int64_t previous = last_keyframe_;
  last_keyframe_ = id;
  if (surfaces_) align_keyframes(frame, previous);
  if (sees_worlds()) look_at_directions(frame);
  if (ground_ || floor_ || motion_) measure_scale(frame, update);
  if (planes_) look_at_planes(frame);
  refine_window();
  pose_between(previous, update);
  frames_since_keyframe_ = 0;
  px_at_keyframe_.clear();
  landmarks_at_keyframe_ = 0;
  for (const PointTrack& track : tracker_.tracks()) {
    px_at_keyframe_[track.id] = track.px.cast<double>();
    landmarks_at_keyframe_ += window_.landmark(track.id).has_value();
  }
  if (lines_) landmarks_at_keyframe_ += lines_->followed(window_);
  update.new_keyframes.push_back({id, frame, sight_});
}

void Odometry::refine_window() {
  const auto span = times_.measure("window");
  const bool alone = window_.keyframes().size() < 2;  // a first stereo or RGB-D keyframe
  const WindowSummary summary = alone ? WindowSummary{} : window_.optimize();
  if (!alone && !summary.outcome)
    log(log_, LogLevel::kWarning, "window not optimized: {}", summary.outcome.reason);
  if (planes_ && !alone) planes_->prune(window_);
  std::vector<double> depths = keep_fitting_landmarks();
  if (lines_) {
    lines_->prune(window_);
    if (!cues_.points) depths = lines_->depths(window_);
    lines_->accept(window_, window_.pose(last_keyframe_));
  }
  if (cues_.surfaces_alone()) depths = {surfaces_->median_depth_m()};
  if (!depths.empty()) median_depth_m_ = std::max(1e-3, median_of(depths));
  if (manhattan_) widen_last_link(window_.pose(window_.keyframes().front()));
  for (const std::int64_t id : window_.keyframes()) keyframe_poses_[id] = window_.pose(id);
  if (rectification_ && !alone) calibrate_eyes();
  const auto keyframes = window_.keyframes();
  // Windows of the lens share no keyframe.
  if (calibration_.baseline_m == 0 && cues_.points && !alone &&
      keyframes.front() > newest_of_lens_ &&
      keyframes.size() > static_cast<std::size_t>(options_.window.max_keyframes)) {
    newest_of_lens_ = keyframes.back();
    lens_.add(window_.lens_evidence());
  }
  const auto leaving = times_.measure("marginalization");
  // Before a keyframe leaves, what it knew of its successor is written down.
  for (std::size_t i = 0;
       i + 1 < keyframes.size() &&
       keyframes.size() - i > static_cast<std::size_t>(options_.window.max_keyframes);
       ++i)
    links_[keyframes[i]] = {motion_information(keyframes[i], keyframes[i + 1]), unit_drift()};
  std::vector<PointLandmark> before;
  if (keyframes.size() > static_cast<std::size_t>(options_.window.max_keyframes))
    for (const std::int64_t id : window_.landmarks())
      if (window_.observations(id).size() > 1) before.push_back(describe_landmark(id));
  for (const std::int64_t left : window_.marginalize()) keyframe_frames_.erase(left);
  for (const PointLandmark& landmark : before)
    if (!window_.landmark(landmark.id)) past_landmarks_.push_back(landmark);
  if (manhattan_) manhattan_->settle(window_);
}

Odometry::Link Odometry::link(std::int64_t id) const {
  const auto link = links_.find(id);
  if (link != links_.end()) return link->second;
  return {motion_information(id, id + 1), unit_drift()};
}

/// Of the unit of length (logarithm), from one keyframe to the next: half a window's worth, spread
/// over its links. The landmarks that both halves see hold it.
double Odometry::unit_drift() const {
  if (scale_known_) return 0;
  constexpr double kMost = 0.1;
  const auto ids = window_.keyframes();
  if (ids.size() < 3) return kMost;
  const double sigma = window_.sigma_log_length_ratio(ids.front(), ids[ids.size() / 2], ids.back());
  return std::min(kMost, sigma / std::sqrt(0.5 * static_cast<double>(ids.size() - 1)));
}

Matrix6d Odometry::motion_information(std::int64_t from, std::int64_t to) const {
  Matrix6d information = window_.relative_information(from, to);
  if (scale_known_) return information;
  // The prior's hold on the unit is arbitrary and common to all motions: no error of this one.
  const SE3 T_from_to = window_.pose(from).inverse() * window_.pose(to);
  const double length = T_from_to.translation().norm();
  if (!(length > 0)) return information;
  const Eigen::Vector3d along = T_from_to.rotation().inverse() * T_from_to.translation() / length;
  const double sigma = std::max(1e-3, unit_drift()) * length;
  information.topLeftCorner<3, 3>() += along * along.transpose() / (sigma * sigma);
  return information;
}

std::int64_t Odometry::window_begin() const {
  const auto ids = window_.keyframes();
  return ids.empty() ? -1 : ids.front();
}

int Odometry::landmarks_in_window() const {
  return static_cast<int>(window_.landmarks().size() + window_.lines().size());
}

PointLandmark Odometry::describe_landmark(std::int64_t id) const {
  const auto& observations = window_.observations(id);
  PointLandmark landmark;
  landmark.id = id;
  landmark.keyframe = observations.front().keyframe;
  landmark.point_cam = window_.pose(landmark.keyframe).inverse() * *window_.landmark(id);
  landmark.observations = static_cast<int>(observations.size());
  return landmark;
}

FrameView Odometry::view() const {
  FrameView view;
  if (lost_) return view;
  const SE3 T_cam_odom = T_odom_last_.inverse();
  for (const PointTrack& track : tracker_.tracks()) {
    FrameView::Track& seen = view.tracks.emplace_back();
    seen.id = track.id;
    seen.px = track.px.cast<double>();
    seen.px_previous = track.px_previous.cast<double>();
    if (const auto point = window_.landmark(track.id))
      seen.px_projected = calibration_.camera.project(T_cam_odom * *point);
  }
  if (lines_) view.lines = lines_->view(window_, T_odom_last_);
  if (manhattan_ && frames_since_keyframe_ == 0) view.directed = manhattan_->view();
  if (surfaces_) view.surfaces = surfaces_->view(newest_motion_);
  if (ground_ && scale_known_) view.ground_px = ground_->outline_px();
  return view;
}

std::vector<PointLandmark> Odometry::landmarks(std::size_t first) const {
  require(first <= past_landmarks_.size(),
          "Odometry::landmarks: those of the window have no order");
  std::vector<PointLandmark> result(past_landmarks_.begin() + static_cast<std::ptrdiff_t>(first),
                                    past_landmarks_.end());
  for (const std::int64_t id : window_.landmarks())
    if (!window_.observations(id).empty()) result.push_back(describe_landmark(id));
  return result;
}

}  // namespace placegraph
