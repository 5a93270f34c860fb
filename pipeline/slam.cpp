#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/parallel.h>
#include <placegraph/graph/map_changes.h>
#include <placegraph/graph/measurements/measured_motion.h>
#include <placegraph/graph/text/log_message.h>
#include <placegraph/pipeline/cues/frame_view.h>
#include <placegraph/pipeline/local_map/lens_estimator.h>
#include <placegraph/pipeline/slam.h>
#include <placegraph/pipeline/slam/event_feed.h>
#include <placegraph/pipeline/slam/image_check.h>
#include <placegraph/pipeline/slam/map_feed.h>
#include <placegraph/pipeline/slam/run_evidence.h>
#include <placegraph/pipeline/slam/track_recovery.h>

#include <algorithm>

namespace placegraph {
struct Slam::Impl {
  Impl(const SlamOptions& o, const Calibration& c, const SlamInputs& inputs)
      : options(o),
        calibration(c),
        log_sink(inputs.log),
        odometry(o.odometry, c, o.seed, log_sink, times),
        closer(o.loops, c, o.seed, inputs.recognizer),
        mapper(o.places, o.pose_graph),
        recovery({o.max_lost_frames, o.odometry.pure_rotation.threshold_px / c.camera.fx},
                 log_sink),
        environments(o.context.filter, c.camera),
        feed(o.views.cues),
        events(inputs.events),
        health(c) {
    if (o.overlays.enabled) overlay.emplace(o.overlays, c.camera, o.seed);
    if (const auto& model = inputs.surfaces)
      odometry.set_scene(std::make_shared<const SurfaceLabeller>(model, o.semantics.masks),
                         o.semantics.enabled);
    if (inputs.motion) recovery.use_motion(inputs.motion), odometry.set_motion(inputs.motion);
  }

  void check_frame(const Frame& frame) const;
  void require_whole() const {
    require(!broken, "Slam: an earlier call threw an exception; use another object");
  }
  /// After a step that throws, no other can follow.
  void perform(const auto& step) {
    require_whole();
    broken = true;
    step();
    broken = false;
  }
  FrameResult add_frame(const Frame& given);
  Frame without_overlay(const Frame& frame);
  void leave_contradicted_map(FrameId frame);
  void place(const Frame& frame, const OdometryUpdate& update, FrameResult& result);
  void record(KeyframeId keyframe, const SE3& T_keyframe_frame, FrameResult& result);
  void rescale(double factor);
  void add_keyframes(const OdometryUpdate& update, FrameResult& result);
  void add_keyframe(const NewKeyframe& keyframe, FrameResult& result);
  void add_motion(KeyframeId keyframe);
  void classify_environment(const NewKeyframe& keyframe);
  void assume_environment() {
    if (options.context.enabled && options.context.assume)
      odometry.assume(environments.assumptions());
  }
  void close_loops(FrameResult& result);
  void optimized(const IncrementalStep& step);
  void take_up(const Map& map, const PlaceHistory& history, const Frame& last, const FrameOf& of);
  RunEvidence learned() { return {odometry, links, health, contradicted, environments, overlay}; }
  std::optional<FrameId> newest_counted() const {
    return recorder.empty() ? counted : std::max(counted, std::optional(recorder.newest().frame));
  }
  /// Whether a frame is not in the evidence of the interrupted run.
  bool is_new(FrameId frame) const { return frame > counted; }
  KnownMap known() const { return {closer, mapper, recorder}; }
  MapSources sources() { return {odometry, closer, mapper, recorder, environments}; }
  /// Keyframes from this one on are still being refined: their places are not merged.
  KeyframeId first_open() const { return odometry.map().window_begin().value_or(kBeforeAll); }

  SlamOptions options;
  Calibration calibration;
  LogSink log_sink;
  StageTimes times;
  Odometry odometry;
  LoopCloser closer;
  PlaceMapper mapper;
  TrackRecovery recovery;
  TrajectoryRecorder recorder;
  EnvironmentMonitor environments;
  LinkFeed links;
  MapFeed feed;
  EventFeed events;
  HealthMonitor health;
  ContradictedSteps contradicted;
  std::optional<StaticOverlay> overlay;
  std::optional<FrameId> counted;         ///< newest frame in the evidence of the interrupted run
  bool finished = false, broken = false;  ///< broken: an exception has left a step unfinished
};

Slam::Slam(const SlamOptions& options, const Calibration& calibration, const SlamInputs& inputs) {
  options.check();
  calibration.check();
  require(inputs.surfaces || !(options.semantics.enabled || options.context.enabled),
          "Slam: semantics and context require a model of surfaces, see SlamInputs::surfaces");
  impl_ = std::make_unique<Impl>(options, calibration, inputs);
}
Slam::~Slam() = default;
Slam::Slam(Slam&&) noexcept = default;
Slam& Slam::operator=(Slam&&) noexcept = default;
const std::vector<EnvironmentObservation>& Slam::environments() const {
  return impl_->environments.observations();
}
FrameResult Slam::add_frame(const Frame& frame) {
  impl_->check_frame(frame);
  FrameResult result;
  impl_->perform([&] { result = impl_->add_frame(frame); });
  return result;
}
MapChanges Slam::take_changes() {
  MapChanges changes = impl_->feed.take_changes(impl_->sources());
  if (const auto& places = changes.places; !places.empty())
    impl_->links.note_errors(places[0].anchor_keyframe, impl_->odometry.map(), impl_->mapper);
  changes.history.evidence = evidence_of(impl_->learned(), impl_->newest_counted());
  changes.run.stages = stages();
  if (impl_->finished) changes.run.notes = notes(), changes.run.odometry_error = odometry_error();
  return changes;
}
void Slam::resume(const Map& map, const PlaceHistory& past, const Frame& last, const FrameOf& of) {
  impl_->perform([&] { impl_->take_up(map, past, last, of); });
}
Map Slam::snapshot() const {
  impl_->require_whole();
  return impl_->feed.snapshot(impl_->sources());
}
LensDistortion Slam::lens() const { return impl_->odometry.lens().estimate(); }
Image Slam::overlay_mask() const { return impl_->overlay ? impl_->overlay->mask() : Image(); }
std::optional<OdometryError> Slam::odometry_error() const {
  return impl_->links.odometry_error(impl_->odometry.map(), impl_->mapper);
}

std::vector<DataNote> Slam::notes() const {
  std::vector<DataNote> notes = impl_->health.notes();
  if (const auto note = impl_->overlay ? impl_->overlay->note() : std::nullopt)
    notes.push_back(*note);
  if (const auto note = impl_->contradicted.note()) notes.push_back(*note);
  return notes;
}
FrameView Slam::view() const { return impl_->odometry.view(); }
const std::vector<StageTime>& Slam::stages() const { return impl_->times.stages(); }
Map Slam::finish() {
  require(!impl_->finished, "Slam::finish: called twice");
  impl_->perform([&] {
    const std::map<KeyframeId, Vector6d> corrections = impl_->odometry.corrections();
    impl_->recorder.correct_motions(corrections, [&](KeyframeId to) {
      const auto motion = impl_->mapper.odometry(KeyframeId(to.value() - 1), to);
      return motion ? std::optional(motion->T_a_b) : std::nullopt;
    });
    impl_->mapper.correct_links(corrections);
    impl_->links.finish(impl_->odometry.map(), impl_->mapper);
    impl_->optimized(impl_->mapper.finish());
    if (impl_->closer.correct_views()) impl_->feed.report_again();
  });
  impl_->finished = true;
  return snapshot();
}

void Slam::Impl::check_frame(const Frame& frame) const {
  require(!finished, "Slam::add_frame: after finish()");
  check_images(frame, calibration);
  require(recorder.accepts(frame),
          "frame " + to_string(frame.id) + ": ids and stamps must increase");
}

/// The frame as it is used: without the static overlay. If that is found in this frame and
/// has captured the map, a new component of the map begins.
Frame Slam::Impl::without_overlay(const Frame& frame) {
  if (!overlay) return frame;
  const auto span = times.measure("static overlays");
  if (is_new(frame.id) && overlay->add(frame)) {
    log(log_sink, LogLevel::kInfo, "frame {}: {}: masked", frame.id, overlay->text());
    if (overlay->has_captured(odometry.view()))
      recovery.begin_component(frame.id, odometry);
    else
      odometry.drop_masked(overlay->mask());
  }
  return overlay->apply(frame);
}

/// If the images contradict a row of rotations, what follows has another scale: the frames lose
/// their poses, and a new component begins.
void Slam::Impl::leave_contradicted_map(FrameId frame) {
  if (!contradicted.row() || odometry.map().metric()) return;
  const FrameId begin = recorder.frame_of(odometry.map().first());
  const FrameId first = contradicted.contradicted_from(begin).value();
  log(log_sink, LogLevel::kInfo, "frames from {} on: the images contradict their poses", first);
  recorder.remove_poses(first, "the images contradict its pose");
  contradicted.end_row();
  recovery.begin_apart(frame, odometry);
}

FrameResult Slam::Impl::add_frame(const Frame& given) {
  recorder.begin(given);
  const Frame frame = without_overlay(given);
  leave_contradicted_map(frame.id);

  // 1. Visual odometry, and after a loss: relocalize, continue with a rotation or other sensors, or
  //    begin a component.
  const OdometryUpdate update = recovery.handle(frame, known(), odometry);

  // 2. Add new keyframes to the place graph, and detect loops.
  FrameResult result;
  result.frame = frame.id;
  if (update.rescale) rescale(update.rescale->factor);
  add_keyframes(update, result);

  // 3. The frame's pose, relative to a keyframe and as currently estimated.
  place(frame, update, result);
  recorder.finish(result.T_map_cam, result.component);
  recorder.explain(result.confidence, result.outcome ? std::string() : result.outcome.reason);
  if (is_new(frame.id)) {
    contradicted.add(frame.id, update.contradicted);
    health.add(frame, result, odometry);
  }
  events.frame_done(result);
  return result;
}

void Slam::Impl::place(const Frame& frame, const OdometryUpdate& update, FrameResult& result) {
  if (update.state == TrackingState::kTracking) {
    result.inliers = update.inliers;
    const double needed = options.odometry.points.pose.ransac.min_inliers;
    if (update.inliers > 0)
      result.confidence = update.agreement * update.inliers / (update.inliers + needed);
    const KeyframeId reference = update.keyframe.value();
    record(reference, odometry.map().pose(reference).inverse() * update.T_odom_cam, result);
  } else if (const auto at = recovery.pose_without_tracking(frame, update, known(), odometry)) {
    record(at->match, at->T_match_query, result);
  } else if (!recorder.newest_keyframe() && update.reference) {
    recorder.begin_at_origin(update.rotation.has_value());
    result.T_map_cam = update.T_odom_cam;
  }
  result.state = result.T_map_cam             ? TrackingState::kTracking
                 : recorder.newest_keyframe() ? TrackingState::kLost
                                              : TrackingState::kInitializing;
  if (result.T_map_cam && odometry.awaits_scale()) {
    // The pose is recovered once the scale of the map is known; until then it would be misleading.
    result.T_map_cam.reset();
    result.state = TrackingState::kInitializing;
    result.outcome =
        Outcome::failure(Outcome::Code::kDegenerate, "the scale of the map is not known yet");
    return;
  }
  if (result.T_map_cam && recorder.newest_has_keyframe())
    result.outcome = Outcome::ok();
  else if (update.outcome.reason.empty())
    result.outcome = Outcome::failure(Outcome::Code::kTooFewData, "a second view is needed");
  else
    result.outcome = update.outcome;
}

void Slam::Impl::record(KeyframeId keyframe, const SE3& T_keyframe_frame, FrameResult& result) {
  recorder.record(keyframe, T_keyframe_frame, result.inliers);
  result.T_map_cam = rigid_part(mapper.S_map_keyframe(keyframe) * Sim3(T_keyframe_frame));
  result.component = mapper.component_of(keyframe);
  recovery.stands_at(*result.T_map_cam);
}

void Slam::Impl::rescale(double factor) {
  const KeyframeId first = odometry.map().first();
  mapper.rescale(first, factor);
  links.rescale(first, factor);
  closer.rescale(factor, first);
  recorder.rescale(first, factor);
  recovery.rescale(factor);
  feed.report_again();
  events.places_changed(mapper, factor);
}

void Slam::Impl::add_keyframes(const OdometryUpdate& update, FrameResult& result) {
  for (const NewKeyframe& keyframe : update.new_keyframes) {
    check_interruption();
    add_keyframe(keyframe, result);
  }
  if (update.new_keyframes.empty()) return;
  result.keyframe = true;
  recorder.correct(update.posed_again, update.new_keyframes.front().id, odometry.map());
}

void Slam::Impl::add_keyframe(const NewKeyframe& keyframe, FrameResult& result) {
  const LocalMap& map = odometry.map();
  std::optional<PlaceMapper::Link> link;
  std::optional<SE3> T_previous_this;
  if (keyframe.id == map.first()) {
    link = recovery.take_link(map, mapper);
  } else {
    const KeyframeId previous = *recorder.newest_keyframe();
    T_previous_this = map.pose(previous).inverse() * map.pose(keyframe.id);
    link = PlaceMapper::Link{previous, *T_previous_this};
  }
  const auto span = times.measure("place graph");
  mapper.add_keyframe(keyframe.id, link, map.pose(keyframe.id), map.median_depth(), map.metric());
  {
    const auto inner = times.measure("constraints");
    // Keyframes leave the window two at a time at most.
    links.refresh(map, keyframe.id, options.odometry.window.max_keyframes + 2, mapper);
  }
  recorder.add_keyframe(keyframe);
  if (recovery.motion()) add_motion(keyframe.id);
  if (options.context.enabled) classify_environment(keyframe);
  // Must precede the loop detection: the covariance test of a loop needs the new place in the
  // optimizer.
  events.keyframe_added(keyframe.id, keyframe.frame.id, mapper);
  if (mapper.is_anchor(keyframe.id)) {
    result.new_place = true;
    optimized(mapper.optimize(first_open()));
  }
  {
    const auto inner = times.measure("described features");
    std::vector<LineFeature> lines;
    if (keyframe.frame.id == recorder.newest().frame) lines = odometry.line_features();
    closer.add_view(keyframe.id, keyframe.frame, T_previous_this, lines, keyframe.errors);
  }
  if (options.views.enabled) {
    const auto inner = times.measure("views of keyframes");
    feed.keep_view(keyframe.id, keyframe.frame, odometry.map());
  }
  if (options.loops.enabled) close_loops(result);
}

/// Adds the measured motion between anchors. The length that provides a monocular camera's scale is
/// not counted twice.
void Slam::Impl::add_motion(KeyframeId keyframe) {
  const auto previous = mapper.previous_anchor(keyframe);
  if (!previous) return;
  const auto motion =
      recovery.motion()->between(recorder.stamp_ns_of(*previous), recorder.stamp_ns_of(keyframe));
  if (!motion) return;
  Matrix6d covariance = motion->covariance;
  const Eigen::Vector3d t = motion->T_a_b.rotation().inverse() * motion->T_a_b.translation();
  if (calibration.baseline_m <= 0 && !calibration.depth)
    covariance.topLeftCorner<3, 3>() += t * t.transpose();
  mapper.add_motion(*previous, keyframe, motion->T_a_b, covariance);
}

void Slam::Impl::classify_environment(const NewKeyframe& keyframe) {
  const auto span = times.measure("environment");
  const SurfaceShares* shares = keyframe.labels ? &keyframe.labels->shares : nullptr;
  if (!environments.classify(keyframe.id, keyframe.frame, shares, odometry.points_cam(),
                             odometry.map().metric()))
    return;
  const FrameId frame = keyframe.frame.id;
  log(log_sink, LogLevel::kInfo, "frame {}: environment {}", frame, environments.name());
  assume_environment();
}

void Slam::Impl::close_loops(FrameResult& result) {
  const KnownMotions motions{
      [&](KeyframeId a, KeyframeId b) { return mapper.odometry(a, b); },
      [&](KeyframeId a, KeyframeId b) { return mapper.predicted(a, b); },
      [&](KeyframeId a, KeyframeId b) { return mapper.scale_unknown(a, b); },
      [&](KeyframeId a, KeyframeId b) { return mapper.component_of(a) != mapper.component_of(b); }};
  const auto loops = [&] {
    const auto span = times.measure("loop closure");
    return closer.find_loops(motions, odometry.map().median_depth());
  }();
  events.loops_decided(closer.records());
  if (loops.empty()) return;
  links.add_loops(loops, odometry.map(), mapper);
  result.loops_accepted += static_cast<int>(loops.size());
  optimized(mapper.optimize(first_open()));
}

void Slam::Impl::optimized(const IncrementalStep& step) {
  if (!step.outcome)
    log(log_sink, LogLevel::kWarning, "place graph not optimized: {}", step.outcome.reason);
  events.places_changed(mapper);
}

void Slam::Impl::take_up(const Map& map, const PlaceHistory& history, const Frame& last,
                         const FrameOf& of) {
  require(recorder.empty() && !finished, "Slam::resume: after the first frame");
  require(!map.keyframes.empty() && map.keyframes.back().frame == last.id,
          "Slam::resume: the frame is not that of the last keyframe");
  check_frame(last);
  PlaceMapper known_places(options.places, options.pose_graph, map.place_graph.places, history);
  closer = LoopCloser(options.loops, calibration, options.seed, map, closer.recognizer(), of);
  mapper = std::move(known_places);
  recorder.take_up(map, last.id, map.main_component());
  feed.take_up(map, closer);
  events.take_up(mapper, closer.records());
  optimized(mapper.optimize());
  const KeyframeId newest = map.keyframes.back().id;
  recovery.take_up(newest, history.median_depth_m, known());
  odometry.go_on_from(++KeyframeId(newest), history.median_depth_m);
  odometry.restart(recovery.T_map_last(), true);
  counted = take_up_evidence(history.evidence, learned(), last);
  assume_environment();
  FrameResult seen_again;
  add_keyframes(odometry.add_frame(last, recovery.T_map_last()), seen_again);
}

}  // namespace placegraph
