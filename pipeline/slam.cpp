#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/slam_impl.h>

#include <algorithm>

namespace placegraph {

void SlamOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, KeyframeViewOptions& o) {
  field("enabled", o.enabled, "keep how keyframes look");
  field.group("cues", o.cues, "cues that views are compared by");
}

void visit(OptionVisitor& field, SceneUseOptions& o) {
  field("enabled", o.enabled, "surfaces of keyframes say what is looked at");
  field.group("masks", o.masks, "what is kept out");
}

void visit(OptionVisitor& field, ContextOptions& o) {
  field("enabled", o.enabled, "kinds of environments are told, and places labelled by them");
  field("assume", o.assume, "motion is seen by what holds in the kind of environment");
  field.group("filter", o.filter, "the kind over views in order of travel");
}

void visit(OptionVisitor& field, SlamOptions& o) {
  field("seed", o.seed, "of every random stream");
  field.group("odometry", o.odometry, "motion memory: relative poses and their window");
  field.group("loops", o.loops, "spatial memory: recognition of places");
  field.group("places", o.places, "topological places");
  field.group("pose_graph", o.pose_graph, "optimization of the place graph");
  field.group("views", o.views, "how keyframes look, for placegraph localize");
  field.group("semantics", o.semantics, "labels of surfaces, for motion and places");
  field.group("context", o.context, "the kind of environment and what is assumed there");
  field("max_lost_frames", o.max_lost_frames, "then a new component of the map begins",
        {1, 1000000});
}

namespace {

/// Of the unit that a run of tracking takes from frames recognized in the map, in logarithms.
constexpr double kSigmaLogScaleOfBridge = 0.1;
/// The same where it is guessed: what comes into view by a turn is about as far away as what left.
constexpr double kSigmaLogScaleOfTurn = 0.7;

}  // namespace

Slam::Slam(const SlamOptions& options, const Calibration& calibration, LogSink log) {
  options.check();
  calibration.check();
  impl_ = std::make_unique<Impl>(options, calibration, std::move(log));
}
Slam::~Slam() = default;
Slam::Slam(Slam&&) noexcept = default;
Slam& Slam::operator=(Slam&&) noexcept = default;

void Slam::set_motion(const MeasuredMotion& motion_cam) {
  require(impl_->records.empty() && !impl_->finished, "Slam::set_motion: after the first frame");
  impl_->motion = std::make_shared<const MeasuredMotion>(motion_cam);
  impl_->odometry.set_motion(impl_->motion);
}

void Slam::set_scene(std::shared_ptr<const SceneModel> surfaces) {
  require(impl_->records.empty() && !impl_->finished, "Slam::set_scene: after the first frame");
  const SceneUseOptions& o = impl_->options.semantics;
  impl_->odometry.set_scene(std::make_shared<const SceneEye>(std::move(surfaces), o.masks),
                            o.enabled);
  impl_->sees_surfaces = true;
}

const std::vector<EnvironmentSight>& Slam::environments() const { return impl_->environments; }

FrameResult Slam::add_frame(const Frame& frame) { return impl_->add_frame(frame); }
MapChanges Slam::take_changes() { return impl_->take_changes(); }
void Slam::go_on_from(const Map& map, const PlaceHistory& history, const Frame& last) {
  impl_->go_on_from(map, history, last);
}
Map Slam::snapshot() const { return impl_->snapshot(); }
const LensEstimator& Slam::lens() const { return impl_->odometry.lens(); }
FrameView Slam::view() const { return impl_->odometry.view(); }
const std::vector<StageTimes::Stage>& Slam::stages() const { return impl_->times.stages(); }

Map Slam::finish() {
  require(!impl_->finished, "Slam::finish: called twice");
  impl_->report(impl_->mapper.finish());
  impl_->finished = true;
  return impl_->snapshot();
}

void Slam::Impl::check_frame(const Frame& frame) const {
  require(!finished, "Slam::add_frame: after finish()");
  require(sees_surfaces || !(options.semantics.enabled || options.context.enabled),
          "Slam: semantics and context need a model of surfaces, see set_scene");
  const Camera& camera = calibration.camera;
  require(frame.image.type() == CV_8UC1 && frame.image.cols == camera.width &&
              frame.image.rows == camera.height,
          "frame " + std::to_string(frame.id) + ": grey image of " + std::to_string(camera.width) +
              "x" + std::to_string(camera.height) + " needed");
  const auto fits = [&](const Image& image, int type, const Camera& of) {
    return image.empty() ||
           (image.type() == type && image.cols == of.width && image.rows == of.height);
  };
  require(fits(frame.right, CV_8UC1, camera) && fits(frame.mask, CV_8UC1, camera) &&
              (!calibration.depth || fits(frame.depth, CV_32FC1, calibration.depth->camera)),
          "frame " + std::to_string(frame.id) +
              ": right eye, mask or depth image of another size or type than calibrated");
  require(records.empty() ||
              (frame.stamp_ns > records.back().stamp_ns && frame.id > records.back().frame),
          "frame " + std::to_string(frame.id) + ": ids and stamps must increase");
}

FrameResult Slam::Impl::add_frame(const Frame& frame) {
  check_frame(frame);
  FrameResult result;
  result.frame = frame.id;
  records.push_back({frame.id, frame.stamp_ns, -1, std::nullopt, 0});

  // A single eye that begins anew within the map waits for its second view; until then every frame
  // is looked up.
  std::optional<Loop> located;
  if (bridge) located = closer.relocalize(frame);
  if (bridge && !located) located = carried(frame);
  if (!bridge && lost_in_a_row >= options.max_lost_frames && !odometry.started()) {
    // Nothing has been seen to begin with yet: each frame is where the other sensors say.
    bridge = located = carried(frame);
    if (bridge) odometry.restart(T_map_located(*bridge), true);
  }
  OdometryUpdate update =
      odometry.add_frame(frame, located ? std::optional(T_map_located(*located)) : std::nullopt);
  if (bridge && !located) located = turned(update);
  if (bridge && update.reference) bridge = located;
  const bool waits_in_vain = posed_once && !bridge && update.state == TrackingState::kWaiting;
  if (update.state == TrackingState::kLost || waits_in_vain) recover(frame, located, update);
  if (update.rescale) apply(*update.rescale);
  add_keyframes(update, result);

  if (update.state == TrackingState::kTracking) {
    lost_in_a_row = 0;
    posed_once = true;
    record_pose(update.keyframe, odometry.map().pose(update.keyframe).inverse() * update.T_odom_cam,
                result);
    records.back().inliers = result.inliers = update.inliers;
  } else if (bridge && (located || lost_in_a_row > 0) && update.state == TrackingState::kWaiting) {
    const Loop at = located ? *located : *bridge;
    if (located || update.reference) record_pose(at.match, at.T_match_query, result);
    if (motion && !odometry.started()) bridge.reset();
  } else if (const auto blind = carried(frame)) {
    record_pose(blind->match, blind->T_match_query, result);
  } else if (!posed_once && update.reference) {
    // The first view is the origin while the second is waited for; if another takes its place, and
    // not by a turn alone, it has no pose after all.
    if (!update.rotation) {
      for (const std::size_t origin : origins) {
        online.poses[origin].T_world_body.reset();
        untold.record = std::min(untold.record, origin);
      }
      origins.clear();
    }
    origins.push_back(records.size() - 1);
    result.T_map_cam = update.T_odom_cam;
  }
  result.state = result.T_map_cam ? TrackingState::kTracking
                 : posed_once     ? TrackingState::kLost
                                  : TrackingState::kWaiting;
  if (result.T_map_cam && odometry.awaits_scale()) {
    // The map will tell it once it has its unit: a pose in another is worse than none.
    result.T_map_cam.reset();
    result.state = TrackingState::kWaiting;
  }
  if (!result.T_map_cam || records.back().keyframe < 0)
    result.reason = update.reason.empty() ? "waits for a second view" : update.reason;
  StampedPose pose{frame.stamp_ns, std::nullopt};
  if (result.T_map_cam && result.component == 0) pose.T_world_body = result.T_map_cam->isometry();
  online.poses.push_back(pose);
  return result;
}

void Slam::Impl::record_pose(std::int64_t keyframe, const SE3& T_keyframe_cam,
                             FrameResult& result) {
  records.back().keyframe = keyframe;
  records.back().T_keyframe_frame = T_keyframe_cam;
  T_map_last = rigid_part(mapper.S_map_keyframe(keyframe) * Sim3(T_keyframe_cam));
  result.T_map_cam = T_map_last;
  result.component = mapper.component_of(keyframe);
}

void Slam::Impl::apply(const Rescale& rescale) {
  const std::int64_t first = odometry.map().first();
  mapper.rescale(first, rescale.factor);
  closer.rescale(rescale.factor, first);
  untold.record = untold.view = untold.landmark = 0;
  T_map_last = T_map_last.scaled(rescale.factor);
  for (FrameRecord& record : records)
    if (record.keyframe >= first && record.T_keyframe_frame)
      record.T_keyframe_frame = SE3(record.T_keyframe_frame->rotation(),
                                    rescale.factor * record.T_keyframe_frame->translation());
}

void Slam::Impl::add_keyframes(const OdometryUpdate& update, FrameResult& result) {
  for (const auto& keyframe : update.new_keyframes) add_keyframe(keyframe, result);
  if (update.new_keyframes.empty()) return;
  result.keyframe = true;
  // Frames from before the initialization hang on its first keyframe, others where they did.
  const std::int64_t first = update.new_keyframes.front().id;
  for (const auto& [frame, T_odom_cam] : update.posed_again)
    if (FrameRecord* record = record_of(frame)) {
      if (record->keyframe < odometry.map().first()) record->keyframe = first;
      record->T_keyframe_frame = odometry.map().pose(record->keyframe).inverse() * T_odom_cam;
    }
}

/// To be changed; nothing for a frame that has none.
FrameRecord* Slam::Impl::record_of(std::int64_t frame) {
  const auto record =
      std::lower_bound(records.begin(), records.end(), frame,
                       [](const FrameRecord& r, std::int64_t id) { return r.frame < id; });
  if (record == records.end() || record->frame != frame) return nullptr;
  untold.record =
      std::min(untold.record, static_cast<std::size_t>(std::distance(records.begin(), record)));
  return &*record;
}

void Slam::Impl::add_keyframe(const NewKeyframe& keyframe, FrameResult& result) {
  const SE3 T_odom_keyframe = odometry.map().pose(keyframe.id);
  const bool begins_run = keyframe.id == odometry.map().first();
  std::optional<PlaceMapper::Link> link;
  std::optional<SE3> T_previous_this;
  if (!begins_run) {
    T_previous_this = odometry.map().pose(last_keyframe).inverse() * T_odom_keyframe;
    link = PlaceMapper::Link{last_keyframe, *T_previous_this};
  } else if (bridge) {
    // The new run is in the map's unit, the match perhaps in another.
    const double sigma_log_scale = odometry.map().metric() ? 0
                                   : odometry.map().scale() == Scale::kGuessed
                                       ? kSigmaLogScaleOfTurn
                                       : kSigmaLogScaleOfBridge;
    const bool same_run = taken_up && odometry.map().metric();
    link = PlaceMapper::Link{bridge->match,
                             bridge->T_match_query,
                             bridge->information.topLeftCorner<6, 6>(),
                             same_run ? ConstraintSource::kOdometry : ConstraintSource::kOther,
                             sigma_log_scale,
                             same_run ? 1 : 1 / mapper.S_map_keyframe(bridge->match).scale()};
    bridge.reset();
  }
  const auto span = times.measure("place graph");
  mapper.add_keyframe(keyframe.id, link, T_odom_keyframe, odometry.map().median_depth(),
                      odometry.map().metric());
  last_keyframe = keyframe.id;
  {
    const auto inner = times.measure("constraints");
    refresh_links();
  }
  frame_of_keyframe[keyframe.id] = keyframe.frame.id;
  stamp_of_keyframe[keyframe.id] = keyframe.frame.stamp_ns;
  if (FrameRecord* record = record_of(keyframe.frame.id)) {
    record->keyframe = keyframe.id;
    record->T_keyframe_frame = SE3();
  }
  if (motion) add_motion(keyframe.id);
  if (options.context.enabled) look_around(keyframe);
  if (mapper.is_anchor(keyframe.id)) {
    result.new_place = true;
    report(mapper.optimize(odometry.map().window_begin().value_or(-1)));
  }
  {
    const auto inner = times.measure("described features");
    const bool newest = keyframe.frame.id == records.back().frame;
    closer.add_view(keyframe.id, keyframe.frame, T_previous_this,
                    newest ? odometry.line_features() : std::vector<LineFeature>());
  }
  if (options.views.enabled) keep_view(keyframe.id, keyframe.frame);
  if (options.loops.enabled) close_loops(result);
}

/// From anchor to anchor. What a single eye took its lengths from does not count again.
void Slam::Impl::add_motion(std::int64_t keyframe) {
  const auto previous = mapper.previous_anchor(keyframe);
  if (!previous) return;
  const auto way = motion->between(stamp_of_keyframe.at(*previous), stamp_of_keyframe.at(keyframe));
  if (!way) return;
  Matrix6d covariance = way->covariance;
  const Eigen::Vector3d t = way->T_a_b.rotation().inverse() * way->T_a_b.translation();
  if (calibration.baseline_m <= 0 && !calibration.depth)
    covariance.topLeftCorner<3, 3>() += t * t.transpose();
  mapper.add_motion(*previous, keyframe, way->T_a_b, covariance);
}

/// The window goes on refining its last keyframes: their links follow. Information of the motion
/// from an anchor to the next one comes from the window as a whole while it holds both.
void Slam::Impl::refresh_links() {
  const std::int64_t from =
      std::max(odometry.map().first(), last_keyframe - options.odometry.window.max_keyframes - 2);
  for (std::int64_t id = from; id < last_keyframe; ++id) {
    mapper.update_link(id + 1, odometry.map().pose(id).inverse() * odometry.map().pose(id + 1));
    const LocalMap::Link link = odometry.map().link(id);
    mapper.inform_link(id + 1, link.information, link.sigma_log_scale);
  }
  const std::int64_t begin = odometry.map().window_begin().value_or(-1);
  for (std::int64_t id = begin + 1; begin >= 0 && id <= last_keyframe; ++id) {
    const auto previous = mapper.previous_anchor(id);
    if (previous && *previous >= begin)
      mapper.inform_anchor(id, odometry.map().motion_information(*previous, id));
  }
}

void Slam::Impl::close_loops(FrameResult& result) {
  const KnownMotions known{
      [&](std::int64_t a, std::int64_t b) { return mapper.odometry(a, b); },
      [&](std::int64_t a, std::int64_t b) { return mapper.predicted(a, b); },
      [&](std::int64_t a, std::int64_t b) { return mapper.units_differ(a, b); }};
  const auto loops = [&] {
    const auto span = times.measure("loop closure");
    return closer.find_loops(known, odometry.map().median_depth());
  }();
  if (loops.empty()) return;
  for (const Loop& loop : loops) mapper.add_loop(loop);
  result.loops_accepted += static_cast<int>(loops.size());
  // Keyframes from the window's first on are still being refined.
  report(mapper.optimize(odometry.map().window_begin().value_or(-1)));
}

void Slam::Impl::report(const IncrementalStep& step) const {
  if (!step.outcome)
    log(log_sink, LogLevel::kWarning, "place graph not optimized: {}", step.outcome.reason);
}

}  // namespace placegraph
