#include <fmt/format.h>
#include <placegraph/frontend/flow/matched_displacements.h>
#include <placegraph/frontend/relative_pose/mono_initializer.h>
#include <placegraph/graph/core/median.h>
#include <placegraph/graph/text/log_message.h>
#include <placegraph/pipeline/cues/point_cue.h>
#include <placegraph/pipeline/odometry/two_view_initializer.h>

#include <set>

namespace placegraph {

TwoViewInitializer::TwoViewInitializer(const OdometryOptions& options,
                                       const Calibration& calibration, std::uint64_t seed,
                                       FeatureTracker& tracker, LogSink log, StageTimes& times)
    : options_(options),
      camera_(calibration.camera),
      seed_(seed),
      tracker_(tracker),
      log_(std::move(log)),
      times_(times) {}

void TwoViewInitializer::restart(const SE3& T_odom_cam) {
  T_odom_restart_ = T_odom_start_ = T_odom_cam;
  views_.clear();
  rotated_.clear();
}

Initialization TwoViewInitializer::add(const Frame& frame, const std::optional<SE3>& T_known,
                                       LocalMap& map, LocalMapping& mapping) {
  PointCue& points = tracker_.points();
  if (!started()) {
    points.track(frame.image);
    return begin(frame, mapping);
  }
  const PointTracker before = points.checkpoint();
  {
    const auto span = times_.measure("point tracking");
    points.track(frame.image);
    if (static_cast<int>(points.tracks().size()) < 2 * options_.initializer.min_points)
      if (PointTracker matched = before; track_near_matches(matched, frame.image) &&
                                         matched.tracks().size() > points.tracks().size())
        points.restore(std::move(matched));
  }
  Initialization result = try_second_view(frame, T_known, map, mapping);
  if (result.state == TrackingState::kLost) points.restore(before);
  return result;
}

std::string TwoViewInitializer::too_few_points() const {
  return fmt::format("{} points of the first view are left, {} needed to estimate the motion",
                     tracker_.points().tracks().size(), 2 * options_.initializer.min_points);
}

TwoViewInitializer::View TwoViewInitializer::view_of(FrameId frame) const {
  View view{frame, {}};
  for (const PointTrack& track : tracker_.points().tracks())
    view.px[track.id] = track.px.cast<double>();
  return view;
}

/// Takes the frame, whose image the tracker has processed, as the first view.
Initialization TwoViewInitializer::begin(const Frame& frame, LocalMapping& mapping) {
  PointCue& points = tracker_.points();
  const KeyframeImages images = mapping.masks().apply(frame);
  points.detect(images.frame.mask, images.masked_by_labels(), images.given_mask);
  const int tracks = static_cast<int>(points.tracks().size());
  if (tracks < 2 * options_.initializer.min_points) {
    points.drop_tracks();  // a dark or empty frame cannot be the first view
    return Initialization::pending(Outcome::failure(
        Outcome::Code::kTooFewData, fmt::format("{} points to track, {} needed to begin", tracks,
                                                2 * options_.initializer.min_points)));
  }
  reference_ = images;
  views_ = {view_of(frame.id)};
  Initialization result;
  result.is_reference = true;
  result.T_odom_reference = T_odom_start_;
  return result;
}

Initialization TwoViewInitializer::try_second_view(const Frame& frame,
                                                   const std::optional<SE3>& T_known, LocalMap& map,
                                                   LocalMapping& mapping) {
  views_.push_back(view_of(frame.id));
  const auto rotation = [&] { return tracker_.rotation_since(views_.front().px, frame.id); };
  if (static_cast<int>(views_.back().px.size()) < 2 * options_.initializer.min_points)
    return replace_reference(frame, T_known, rotation(), map, mapping);
  MonoInitialization start = motion_to_newest();
  if (start.outcome && rotation())
    start.outcome = Outcome::failure(Outcome::Code::kDegenerate, "a rotation explains the views");
  if (!start.outcome) {
    log(log_, LogLevel::kDebug, "initialization pending: {}", start.outcome.reason);
    return add_pending(frame, start.outcome);
  }
  const auto scale = scale_of(start, T_known, map, mapping);
  if (!scale) {
    const Outcome no_scale = no_scale_of_map();
    log(log_, LogLevel::kDebug, "initialization pending: {}", no_scale.reason);
    return Initialization::pending(no_scale);
  }
  if (!(*scale > 0)) return {};
  return accept(frame, start, *scale, map, mapping);
}

/// Some views between the first and the newest one, used to test the motion, with tracks of the
/// newest; a few are sufficient for any time until then.
std::vector<PartialView> TwoViewInitializer::views_between() const {
  // Views that are tested: the cost. Chosen.
  constexpr std::size_t kJudges = 16;
  std::map<LandmarkId, int> index;
  const auto& tracks = tracker_.points().tracks();
  for (std::size_t i = 0; i < tracks.size(); ++i) index[tracks[i].id] = static_cast<int>(i);
  std::vector<PartialView> between;
  const std::size_t stride = views_.size() / kJudges + 1;
  for (std::size_t v = 1; v + 1 < views_.size(); v += stride) {
    between.emplace_back();
    for (const auto& [id, px] : views_[v].px)
      if (const auto i = index.find(id); i != index.end())
        between.back().emplace_back(i->second, px);
  }
  return between;
}

MonoInitialization TwoViewInitializer::motion_to_newest() const {
  Random random(seed_, "two views", {views_.back().frame.value()});
  std::vector<Eigen::Vector2d> px_ref, px_cur;
  for (const PointTrack& track : tracker_.points().tracks()) {
    px_ref.push_back(views_.front().px.at(track.id));
    px_cur.push_back(track.px.cast<double>());
  }
  return initialize_mono(camera_, px_ref, px_cur, views_between(), options_.initializer, random);
}

/// Length in the map of the unit translation between the two views. Without a measurement, the
/// depth of the scene is assumed to be that of the map. Nothing if the scale of the map requires a
/// recognized view.
std::optional<double> TwoViewInitializer::scale_of(const MonoInitialization& start,
                                                   const std::optional<SE3>& T_known,
                                                   const LocalMap& map,
                                                   const LocalMapping& mapping) const {
  if (map.scale() == Scale::kFromMap) {
    if (T_known) return (T_known->translation() - T_odom_start_.translation()).norm();
    if (!mapping.scale().uses_ground_plane()) return std::nullopt;
  }
  std::vector<double> depths;
  for (const auto& point : start.points_ref)
    if (point) depths.push_back(point->z());
  return map.median_depth() / median_of(depths);
}

Initialization TwoViewInitializer::accept(const Frame& frame, const MonoInitialization& start,
                                          double scale, LocalMap& map, LocalMapping& mapping) {
  PointCue& points = tracker_.points();
  const KeyframeImages newest = mapping.masks().apply(frame);
  const KeyframeId ref = map.add_keyframe(T_odom_start_, reference_.frame.stamp_ns);
  const KeyframeId cur = map.add_keyframe(
      T_odom_start_ * SE3(start.T_ref_cur.rotation(), scale * start.T_ref_cur.translation()),
      frame.stamp_ns);
  std::vector<PointCue::TwoViewPoint> pairs;
  for (std::size_t i = 0; i < points.tracks().size(); ++i) {
    const PointTrack& track = points.tracks()[i];
    pairs.push_back({track.id, views_.front().px.at(track.id), track.px.cast<double>(),
                     track.covariance.cast<double>(), std::nullopt});
    if (start.points_ref[i])
      pairs.back().point_odom = T_odom_start_ * (scale * *start.points_ref[i]);
  }
  points.observe_two_views(ref, cur, pairs, map.window());
  mapping.refine(tracker_, map);
  if (mapping.scale().available()) {
    mapping.scale().remember(ref, reference_.frame);
    tracker_.observe_directions(newest.frame.image, map);
    mapping.measure_scale(newest, tracker_, map);  // these keyframes have not been reported yet
    mapping.refine(tracker_, map);
  }

  Initialization begun;
  begun.state = TrackingState::kTracking;
  begun.keyframes = {{ref, reference_.frame, reference_.labels},
                     {cur, newest.frame, newest.labels}};
  begun.posed = std::move(rotated_);  // poses from points, which follow, are more accurate
  for (PosedFrame& posed : pose_views_between(map)) begun.posed.push_back(std::move(posed));
  const double steps = static_cast<double>(views_.size() - 1);
  begun.T_last_cur =
      SE3::exp((map.window().pose(ref).inverse() * map.window().pose(cur)).log() / steps);
  rotated_.clear();
  views_.clear();
  points.detect(newest.frame.mask, newest.masked_by_labels(), newest.given_mask);
  points.observe_new_tracks(cur);
  begun.inliers = static_cast<int>(map.window().landmarks().size());
  tracker_.start_selection(begun.inliers);
  return begun;
}

/// Poses the views between the map's two keyframes from points shared with them.
std::vector<PosedFrame> TwoViewInitializer::pose_views_between(const LocalMap& map) const {
  const SlidingWindow& window = map.window();
  const SE3 T_odom_ref = window.pose(map.first()), T_odom_cur = window.pose(map.newest());
  std::vector<PosedFrame> posed;
  for (std::size_t v = 1; v + 1 < views_.size(); ++v) {
    std::vector<Eigen::Vector3d> points;
    std::vector<Eigen::Vector2d> px;
    for (const auto& [id, pixel] : views_[v].px)
      if (const auto point = window.landmark(id)) {
        points.push_back(*point);
        px.push_back(pixel);
      }
    Random random(seed_, "pose of a view between", {views_[v].frame.value()});
    const double share = static_cast<double>(v) / (views_.size() - 1);
    const SE3 prior = T_odom_ref * SE3::exp(share * (T_odom_ref.inverse() * T_odom_cur).log());
    const auto pose = estimate_pose_3d2d(camera_, points, px, options_.points.pose, random, &prior);
    if (pose.outcome) posed.emplace_back(views_[v].frame, pose.T_ref_cam);
  }
  return posed;
}

/// Handles a frame before the second view is found: its pose is that of its rotation.
Initialization TwoViewInitializer::add_pending(const Frame& frame, Outcome outcome) {
  Initialization result = Initialization::pending(std::move(outcome));
  result.rotation = tracker_.rotation_since(views_.front().px, frame.id);
  if (!result.rotation) return result;
  rotated_.emplace_back(frame.id, T_odom_start_ * SE3(result.rotation->R_before_cam, {0, 0, 0}));
  // Limit for a stationary camera: these views are posed, and a few are sufficient for the test.
  constexpr std::size_t kMostViews = 64;
  if (views_.size() > kMostViews) {
    std::set<FrameId> posed;
    for (const PosedFrame& rotated : rotated_) posed.insert(rotated.first);
    std::size_t k = 0;
    std::erase_if(views_, [&](const View& v) { return k++ % 2 == 1 && posed.contains(v.frame); });
  }
  return result;
}

/// Replaces the reference by this frame when too few points of the reference remain.
Initialization TwoViewInitializer::replace_reference(const Frame& frame,
                                                     const std::optional<SE3>& T_known,
                                                     const std::optional<PureRotation>& rotation,
                                                     LocalMap& map, LocalMapping& mapping) {
  const Outcome outcome = Outcome::failure(Outcome::Code::kTooFewData, too_few_points());
  const FrameId reference = reference_.frame.id;
  const SE3 T_odom_before = T_odom_start_;
  views_.clear();
  tracker_.points().drop_tracks();
  if (map.scale() == Scale::kFromMap && !T_known && !rotation) {
    Initialization lost = Initialization::pending(outcome);
    lost.state = TrackingState::kLost;
    return lost;
  }
  if (rotation)
    rotated_.emplace_back(reference, T_odom_before);
  else
    rotated_.clear();  // their poses depend on the old reference
  T_odom_start_ = T_odom_restart_;
  if (T_known) {
    T_odom_start_ = *T_known;
  } else if (rotation) {
    T_odom_start_ = T_odom_before * SE3(rotation->R_before_cam, Eigen::Vector3d::Zero());
    // The part of the map that would provide the scale is out of view.
    if (map.scale() == Scale::kFromMap) map.set_scale(Scale::kGuessed);
  }
  tracker_.points().track(frame.image);
  Initialization result = begin(frame, mapping);
  result.rotation = rotation;
  if (result.outcome.reason.empty()) result.outcome = outcome;
  if (!result.is_reference) {  // the next frames have no known pose
    result.rotation.reset();
    rotated_.clear();
    T_odom_start_ = T_odom_restart_;
  }
  return result;
}

}  // namespace placegraph
