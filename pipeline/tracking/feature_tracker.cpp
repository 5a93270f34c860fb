#include <fmt/format.h>
#include <placegraph/frontend/cloud_planes/depth_planes.h>
#include <placegraph/frontend/flow/point_tracker.h>
#include <placegraph/frontend/relative_pose/rotation_2d2d.h>
#include <placegraph/graph/core/time.h>
#include <placegraph/pipeline/cues/determined_rotation.h>
#include <placegraph/pipeline/tracking/feature_tracker.h>
#include <placegraph/pipeline/tracking/line_pose.h>
#include <placegraph/pipeline/tracking/rotation_check.h>

#include <algorithm>

namespace placegraph {

FeatureTracker::FeatureTracker(const OdometryOptions& options, const Calibration& calibration,
                               std::uint64_t seed, LogSink log, StageTimes& times)
    : options_(options),
      calibration_(calibration),
      cues_(parse_cues(options.cues)),
      seed_(seed),
      log_(std::move(log)),
      times_(times),
      points_(options.points, calibration, options.stereo, times),
      selector_(options.keyframe, calibration.camera, options.points.pose.ransac.min_inliers),
      intermediate_(options.points.pose, calibration.camera) {
  const bool metric = metric_from_start(cues_, calibration);
  if (cues_.lines) lines_.emplace(options.lines, calibration, options.stereo);
  if (lines_ && !cues_.points && !metric) lines_->use_vanishing_directions();
  if (cues_.manhattan) manhattan_.emplace(options.manhattan, calibration.camera, seed_, log_);
  if (options.planes.enabled && calibration.depth) planes_.emplace(options.planes, log_);
  if (cues_.direct) direct_.emplace(options.direct, calibration, options.stereo);
}

void FeatureTracker::reset() {
  points_.reset();
  if (lines_) lines_->reset();
  if (manhattan_) manhattan_->reset();
  if (planes_) planes_->reset();
  if (direct_) direct_->reset();
  selector_.reset();
  intermediate_.clear();
  velocity_.reset();
  stamp_ns_.reset();
  points_.set_velocity(velocity_.at());
}

void FeatureTracker::drop_masked(const Image& mask, LocalMap& map) {
  points_.drop_masked(mask, map.window());
}

void FeatureTracker::see_first(const Frame& frame) {
  if (cues_.points) points_.track(frame.image);
}

TrackedFrame FeatureTracker::track(const Frame& frame, const LocalMap& map,
                                   const MotionModel& motion) {
  const PointTracker points_before = points_.checkpoint();
  const std::optional<LineCue> lines_before = lines_;
  const SlidingWindow& window = map.window();
  const auto [points, keep, landmarks] = pose_by_points(frame, map, motion);
  TrackedFrame tracked;
  tracked.outcome = points.outcome;
  tracked.T_odom_cam = points.T_ref_cam;
  tracked.inliers = static_cast<int>(points.inliers.size());
  if (points.outcome) {
    tracked.agreement = static_cast<double>(tracked.inliers) / landmarks;
    if (tracked.agreement < options_.min_agreement)
      tracked.outcome = Outcome::failure(
          Outcome::Code::kNoConsensus, fmt::format("{} of {} tracked landmarks agree with the pose",
                                                   tracked.inliers, landmarks));
  }
  Matrix6d information = points.information;
  if (lines_) {
    Random random(seed_, "pose from lines", {frame.id.value()});
    const PoseFromLines both =
        pose_with_lines(*lines_, frame.image, window, motion, points, map.median_depth(), random);
    tracked.outcome = both.outcome;
    tracked.T_odom_cam = both.T_ref_cam;
    tracked.inliers += static_cast<int>(both.inliers.size());
    information = both.information;
    if (!both.outcome && cues_.points)
      tracked.outcome.reason = points.outcome.reason + "; " + both.outcome.reason;
  }
  // Measured depths and Manhattan frames know more about the rotation.
  constexpr double kMostSigmaDeg = 1;
  if (tracked.outcome && monocular_points() && !manhattan())
    tracked.outcome = determines_rotation(information, kMostSigmaDeg);
  if (!tracked.outcome) {
    tracked.rotation = rotation_since(selector_.px_at_keyframe(), frame.id);
    points_.restore(points_before);
    lines_ = lines_before;
    return tracked;
  }
  const auto manhattan_rotation =
      rotation_from_manhattan(frame, tracked.T_odom_cam, tracked.inliers, map);
  tracked.T_odom_cam =
      with_manhattan_rotation(tracked.T_odom_cam, information, manhattan_rotation, window);
  tracked.contradicted = monocular_points() &&
                         contradicted(frame.id, motion.T_odom_cam().inverse() * tracked.T_odom_cam);
  remember_motion(frame, motion.T_odom_cam(), tracked.T_odom_cam);
  points_.keep(keep);
  selector_.count_frame();
  tracked.keyframe_due = keyframe_due(tracked.T_odom_cam, tracked.inliers, map);
  if (!tracked.keyframe_due)
    intermediate_.remember({frame.id,
                            map.window().pose(map.newest()).inverse() * tracked.T_odom_cam,
                            points_.landmark_pixels(window, tracked.T_odom_cam),
                            manhattan_rotation,
                            {points_.errors(), velocity_.at()}});
  return tracked;
}

/// Errors of times displace points in proportion to the velocity, which is known better after
/// the first estimate: the pose is estimated twice.
PointCue::TrackedPose FeatureTracker::pose_by_points(const Frame& frame, const LocalMap& map,
                                                     const MotionModel& motion) {
  Random random(seed_, "pose from points", {frame.id.value()});
  const SlidingWindow& window = map.window();
  if (!cues_.points) return points_.pose(window, motion.predicted(), random);
  const double interval_s = stamp_ns_ ? seconds(*stamp_ns_, frame.stamp_ns) : 0;
  if (points_.errors().any()) points_.set_velocity(velocity_.at(interval_s));
  PointCue::TrackedPose found =
      points_.follow(frame.image, window, motion.T_odom_cam(), motion.predicted(),
                     motion.velocity_known(), map.median_depth(), random);
  if (!points_.errors().any() || !found.pose.outcome) return found;
  CameraVelocity velocity = velocity_;
  velocity.update(motion.T_odom_cam().inverse() * found.pose.T_ref_cam, interval_s);
  points_.set_velocity(velocity.at());
  return points_.pose(window, found.pose.T_ref_cam, random);
}

void FeatureTracker::remember_motion(const Frame& frame, const SE3& T_odom_last,
                                     const SE3& T_odom_cam) {
  if (stamp_ns_)
    velocity_.update(T_odom_last.inverse() * T_odom_cam, seconds(*stamp_ns_, frame.stamp_ns));
  stamp_ns_ = frame.stamp_ns;
  points_.set_velocity(velocity_.at());
}

bool FeatureTracker::monocular_points() const {
  return cues_.points && !metric_from_start(cues_, calibration_);
}

/// All tracks count, also those that contradict the pose.
bool FeatureTracker::contradicted(FrameId frame, const SE3& T_previous_this) const {
  Random random(seed_, "rotation check", {frame.value()});
  return contradicts_rotation(calibration_.camera, points_.tracks(), T_previous_this,
                              options_.initializer.two_view, random);
}

/// Rotation from Manhattan frames for a frame whose pose has few inliers.
std::optional<ManhattanCue::RotationEstimate> FeatureTracker::rotation_from_manhattan(
    const Frame& frame, const SE3& T_odom_cam, int inliers, const LocalMap& map) const {
  if (!manhattan() || inliers >= options_.manhattan.few_points) return std::nullopt;
  return manhattan_->manhattan_rotation(frame.image, T_odom_cam.rotation(), map.window(),
                                        map.newest());
}

bool FeatureTracker::keyframe_due(const SE3& T_odom_cam, int inliers, const LocalMap& map) const {
  const bool more_tracks = cues_.points && static_cast<int>(points_.tracks().size()) > inliers;
  const SE3 T_keyframe_cam = map.window().pose(map.newest()).inverse() * T_odom_cam;
  return selector_.due({inliers, more_tracks,
                        lines_ && !cues_.points
                            ? lines_->flow_px()
                            : selector_.flow_px(points_.tracks(), T_keyframe_cam.rotation())});
}

std::optional<PureRotation> FeatureTracker::rotation_since(
    const std::map<LandmarkId, Eigen::Vector2d>& px_before, FrameId frame) const {
  if (!monocular_points()) return std::nullopt;
  std::vector<Eigen::Vector2d> px_ref, px_cur;
  for (const PointTrack& track : points_.tracks())
    if (const auto before = px_before.find(track.id); before != px_before.end()) {
      px_ref.push_back(before->second);
      px_cur.push_back(track.px.cast<double>());
    }
  Random random(seed_, "rotation", {frame.value()});
  const Rotation2d2dResult rotation =
      estimate_rotation_2d2d(calibration_.camera, px_ref, px_cur, options_.pure_rotation, random);
  if (!rotation.outcome) return std::nullopt;
  return PureRotation{rotation.R_ref_cur, rotation.covariance};
}

std::optional<SE3> FeatureTracker::prepare_keyframe(const KeyframeImages& images,
                                                    const SE3& T_odom_cam,
                                                    const LocalMap& /*map*/) {
  if (!cues_.points) return T_odom_cam;
  const auto span = times_.measure("point detection");
  intermediate_.correct_drift(points_.anchor());
  if (images.labels) points_.drop_tracks_on_movable_objects(images.labels->masks.still);
  points_.detect(images.frame.mask, images.masked_by_labels(), images.given_mask);
  return T_odom_cam;
}

void FeatureTracker::observe(const KeyframeImages& images, const RectificationError& rectification,
                             LocalMap& map) {
  const Frame& frame = images.frame;
  const KeyframeId id = map.newest();
  if (!stamp_ns_) stamp_ns_ = frame.stamp_ns;
  points_.observe(id, frame, rectification, map.window());
  if (lines_) {
    lines_->observe(id, frame, rectification, map.median_depth(), map.window());
    if (!cues_.points) lines_->constrain_translation(id, map.median_depth(), map.window());
  }
  if (direct_) direct_->forget_newest();
  if (direct_ && map.metric()) {
    const auto span = times_.measure("surfaces");
    Random random(seed_, "surfaces", {frame.id.value()});
    direct_->add({id, frame, images.ground(), points_.landmark_depths(map.window(), id)},
                 map.before_newest(), rectification, map.window(), random);
  }
  observe_directions(frame.image, map);
  if (planes_ && !frame.depth.empty()) observe_planes(frame, map);
}

/// Tracked lines serve as its edges, where there are any.
void FeatureTracker::observe_directions(const Image& image, LocalMap& map) {
  if (!manhattan()) return;
  const auto span = times_.measure("directions");
  const SlidingWindow& window = map.window();
  std::optional<std::vector<LineSegment>> segments;
  if (lines_) {
    segments.emplace();
    for (const FrameView::Line& line : lines_->view(window, window.pose(map.newest())))
      segments->push_back(line.segment);
    if (segments->empty()) segments.reset();  // no lines are tracked yet
  }
  manhattan_->observe(map.newest(), image, segments, map.window());
}

/// Only a depth camera is used for planes: stereo depth of blank walls is smooth, but wrong.
void FeatureTracker::observe_planes(const Frame& frame, LocalMap& map) {
  const auto span = times_.measure("planes");
  std::vector<DepthPlane> planes;
  for (const DepthPlane& plane :
       find_depth_planes(frame.depth, calibration_.depth->camera, options_.planes.depth))
    planes.push_back(transform(calibration_.depth->T_cam_depth, plane));
  planes_->add(map.newest(), planes, map.window());
}

std::vector<double> FeatureTracker::prune(LocalMap& map) {
  SlidingWindow& window = map.window();
  if (planes_ && window.keyframes().size() > 1) planes_->prune(window);
  std::vector<double> depths = points_.prune(window, map.newest());
  if (lines_) {
    lines_->prune(window);
    if (!cues_.points) depths = lines_->depths(window);
    lines_->accept(window, window.pose(map.newest()));
  }
  return depths;
}

void FeatureTracker::settle(const LocalMap& map) {
  if (manhattan_) manhattan_->settle(map.window());
}

std::vector<PosedFrame> FeatureTracker::finish_keyframe(double scale, const LocalMap& map) {
  start_selection(points_.tracked_landmarks(map.window()) +
                  (lines_ ? lines_->followed(map.window()) : 0));
  const auto previous = map.before_newest();
  return previous ? intermediate_.repose(map, *previous, scale, points_.errors())
                  : std::vector<PosedFrame>();
}

void FeatureTracker::start_selection(int landmarks) {
  selector_.start(points_.tracks(), landmarks);
}

Outcome FeatureTracker::enough_to_begin(const LocalMap& map) const {
  const int needed = options_.points.pose.ransac.min_inliers;
  if (map.landmarks_in_window() >= needed) return Outcome::ok();
  return Outcome::failure(Outcome::Code::kTooFewData,
                          fmt::format("{} of {} tracked points {}, {} needed to begin",
                                      map.landmarks_in_window(), points_.tracks().size(),
                                      calibration_.baseline_m > 0 ? "found in the right image"
                                                                  : "with a measured depth",
                                      needed));
}

void FeatureTracker::assume(const std::optional<Assumptions>& assumptions) {
  manhattan_trusted_ = !assumptions || assumptions->manhattan_frame;
  if (assumptions && assumptions->manhattan_frame && !manhattan_ && cues_.points)
    manhattan_.emplace(options_.manhattan, calibration_.camera, seed_, log_);
}

const ManhattanCue* FeatureTracker::manhattan() const {
  return manhattan_ && manhattan_trusted_ ? &*manhattan_ : nullptr;
}

std::vector<Eigen::Vector3d> FeatureTracker::points_odom(const LocalMap& map) const {
  std::vector<Eigen::Vector3d> points;
  for (const PointTrack& track : points_.tracks())
    if (const auto point = map.window().landmark(track.id)) points.push_back(*point);
  return points;
}

FrameView FeatureTracker::view(const LocalMap& map, const SE3& T_odom_cam) const {
  FrameView view;
  const SE3 T_cam_odom = T_odom_cam.inverse();
  for (const PointTrack& track : points_.tracks()) {
    FrameView::Track& seen = view.tracks.emplace_back();
    seen.id = track.id;
    seen.px = track.px.cast<double>();
    seen.px_previous = track.px_previous.cast<double>();
    if (const auto point = map.window().landmark(track.id)) {
      seen.point_cam = T_cam_odom * *point;
      seen.px_projected = calibration_.camera.project(*seen.point_cam);
    }
  }
  if (lines_) view.lines = lines_->view(map.window(), T_odom_cam);
  if (manhattan_ && selector_.frames() == 0) view.directed = manhattan_->view();
  if (direct_) view.surfaces = direct_->view();
  return view;
}

}  // namespace placegraph
