#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/slam.h>

#include <algorithm>

namespace placegraph {

void SlamOptions::check() const {
  check_ranges(*this);
  odometry.check();
  loops.check();
  places.check();
  pose_graph.check();
}

void visit(OptionVisitor& field, SlamOptions& o) {
  field("seed", o.seed, "of every random stream");
  field.group("odometry", o.odometry, "motion memory: relative poses and their window");
  field.group("loops", o.loops, "spatial memory: recognition of places");
  field.group("places", o.places, "topological places");
  field.group("pose_graph", o.pose_graph, "optimization of the place graph");
  field("optimize_interval", o.optimize_interval,
        "keyframes between optimizations while loops come in", {1, 100000});
  field("max_lost_frames", o.max_lost_frames, "then a new component of the map begins",
        {1, 1000000});
}

struct Slam::Impl {
  Impl(const SlamOptions& o, const Calibration& c, LogSink l)
      : options(o),
        calibration(c),
        log_sink(std::move(l)),
        odometry(o.odometry, c, o.seed, log_sink),
        closer(o.loops, c, o.seed),
        mapper(o.places) {}

  FrameResult add_frame(const Frame& frame);
  void check_frame(const Frame& frame) const;
  void recover(const Frame& frame, OdometryUpdate& update);
  void add_keyframes(const OdometryUpdate& update, FrameResult& result);
  void add_keyframe(const OdometryUpdate::NewKeyframe& keyframe, FrameResult& result);
  void refresh_links();
  void close_loops(FrameResult& result);
  void optimize();
  void apply(const OdometryUpdate::Rescale& rescale);
  SE3 T_map_cam(const OdometryUpdate& update) const;
  Map snapshot() const;

  SlamOptions options;
  Calibration calibration;
  LogSink log_sink;
  Odometry odometry;
  LoopCloser closer;
  PlaceMapper mapper;

  std::vector<FrameRecord> records;
  Trajectory online;
  std::map<std::int64_t, std::int64_t> frame_of_keyframe, stamp_of_keyframe;
  std::int64_t last_keyframe = -1;
  std::optional<Loop> bridge;  // how the next run of tracking hangs on the last one
  SE3 T_map_last;
  int lost_in_a_row = 0, keyframes_since_optimization = 0;
  bool loops_waiting = false, posed_once = false, finished = false;
};

Slam::Slam(const SlamOptions& options, const Calibration& calibration, LogSink log) {
  options.check();
  calibration.check();
  impl_ = std::make_unique<Impl>(options, calibration, std::move(log));
}
Slam::~Slam() = default;
Slam::Slam(Slam&&) noexcept = default;
Slam& Slam::operator=(Slam&&) noexcept = default;

FrameResult Slam::add_frame(const Frame& frame) { return impl_->add_frame(frame); }
Map Slam::snapshot() const { return impl_->snapshot(); }

Map Slam::finish() {
  impl_->refresh_links();
  if (impl_->loops_waiting) impl_->optimize();
  impl_->finished = true;
  return impl_->snapshot();
}

void Slam::Impl::check_frame(const Frame& frame) const {
  require(!finished, "Slam::add_frame: after finish()");
  const Camera& camera = calibration.camera;
  require(frame.image.type() == CV_8UC1 && frame.image.cols == camera.width &&
              frame.image.rows == camera.height,
          "frame " + std::to_string(frame.id) + ": grey image of " + std::to_string(camera.width) +
              "x" + std::to_string(camera.height) + " needed");
  require(records.empty() ||
              (frame.stamp_ns > records.back().stamp_ns && frame.id > records.back().frame),
          "frame " + std::to_string(frame.id) + ": ids and stamps must increase");
}

FrameResult Slam::Impl::add_frame(const Frame& frame) {
  check_frame(frame);
  FrameResult result;
  result.frame = frame.id;
  records.push_back({frame.id, frame.stamp_ns, -1, std::nullopt});

  OdometryUpdate update = odometry.add_frame(frame);
  if (update.state == TrackingState::kLost ||
      (posed_once && lost_in_a_row > 0 && update.state == TrackingState::kWaiting))
    recover(frame, update);
  if (update.rescale) apply(*update.rescale);
  add_keyframes(update, result);

  if (update.state == TrackingState::kTracking) {
    lost_in_a_row = 0;
    posed_once = true;
    records.back().keyframe = update.keyframe;
    records.back().T_keyframe_frame =
        odometry.keyframe_pose(update.keyframe).inverse() * update.T_odom_cam;
    T_map_last = T_map_cam(update);
    result.T_map_cam = T_map_last;
    result.inliers = update.inliers;
    result.component = mapper.component_of(update.keyframe);
  } else if (!posed_once && records.size() == 1) {
    // The first frame is the origin, also while mono waits for its second view.
    result.T_map_cam = SE3();
  }
  StampedPose pose{frame.stamp_ns, std::nullopt};
  if (result.T_map_cam && result.component == 0) pose.T_world_body = result.T_map_cam->isometry();
  online.poses.push_back(pose);
  return result;
}

SE3 Slam::Impl::T_map_cam(const OdometryUpdate& update) const {
  return mapper.T_map_keyframe(update.keyframe) *
         (odometry.keyframe_pose(update.keyframe).inverse() * update.T_odom_cam);
}

void Slam::Impl::recover(const Frame& frame, OdometryUpdate& update) {
  ++lost_in_a_row;
  if (update.state == TrackingState::kLost) refresh_links();
  if (const auto found = closer.relocalize(frame)) {
    log(log_sink, LogLevel::kInfo,
        "frame " + std::to_string(frame.id) + " relocalized at frame " +
            std::to_string(frame_of_keyframe.at(found->match)));
    // The new run begins here; its odometry frame is the map frame of this moment.
    bridge = found;
    odometry.restart(mapper.T_map_keyframe(found->match) * found->T_match_query);
    update = odometry.add_frame(frame);
  } else if (lost_in_a_row == options.max_lost_frames) {
    log(log_sink, LogLevel::kInfo,
        "frame " + std::to_string(frame.id) + ": a new component of the map begins");
    bridge.reset();
    odometry.restart(T_map_last);
    update = odometry.add_frame(frame);
  }
}

void Slam::Impl::apply(const OdometryUpdate::Rescale& rescale) {
  const std::int64_t first = odometry.first_keyframe();
  mapper.rescale(first, rescale.factor);
  closer.rescale(rescale.factor, first);
  for (FrameRecord& record : records)
    if (record.keyframe >= first && record.T_keyframe_frame)
      record.T_keyframe_frame = SE3(record.T_keyframe_frame->rotation(),
                                    rescale.factor * record.T_keyframe_frame->translation());
}

void Slam::Impl::add_keyframes(const OdometryUpdate& update, FrameResult& result) {
  for (const auto& keyframe : update.new_keyframes) add_keyframe(keyframe, result);
  if (update.new_keyframes.empty()) return;
  result.keyframe = true;
  // Frames from before the initialization hang on its first keyframe.
  const std::int64_t first = update.new_keyframes.front().id;
  for (const auto& [frame, T_odom_cam] : update.filled)
    for (FrameRecord& record : records)
      if (record.frame == frame) {
        record.keyframe = first;
        record.T_keyframe_frame = odometry.keyframe_pose(first).inverse() * T_odom_cam;
      }
}

void Slam::Impl::add_keyframe(const OdometryUpdate::NewKeyframe& keyframe, FrameResult& result) {
  const SE3 T_odom_keyframe = odometry.keyframe_pose(keyframe.id);
  const bool begins_run = keyframe.id == odometry.first_keyframe();
  std::optional<PlaceMapper::Link> link;
  std::optional<SE3> T_previous_this;
  if (!begins_run) {
    T_previous_this = odometry.keyframe_pose(last_keyframe).inverse() * T_odom_keyframe;
    link = {last_keyframe, *T_previous_this, Matrix6d::Zero(), ConstraintSource::kOdometry};
  } else if (bridge) {
    link = {bridge->match, bridge->T_match_query, bridge->information, ConstraintSource::kOther};
    bridge.reset();
  }
  refresh_links();
  mapper.add_keyframe(keyframe.id, link, T_odom_keyframe, odometry.median_depth_m());
  last_keyframe = keyframe.id;
  frame_of_keyframe[keyframe.id] = keyframe.frame.id;
  stamp_of_keyframe[keyframe.id] = keyframe.frame.stamp_ns;
  for (FrameRecord& record : records)
    if (record.frame == keyframe.frame.id) {
      record.keyframe = keyframe.id;
      record.T_keyframe_frame = SE3();
    }
  closer.add_view(keyframe.id, keyframe.frame, T_previous_this);
  if (options.loops.enabled) close_loops(result);
}

/// The window goes on refining its last keyframes: their links follow.
void Slam::Impl::refresh_links() {
  const std::int64_t first = odometry.first_keyframe();
  const std::int64_t from =
      std::max(first, last_keyframe - options.odometry.window.max_keyframes - 1);
  for (std::int64_t id = from; id < last_keyframe; ++id)
    mapper.update_link(id + 1,
                       odometry.keyframe_pose(id).inverse() * odometry.keyframe_pose(id + 1),
                       odometry.link_information(id));
}

void Slam::Impl::close_loops(FrameResult& result) {
  const auto loops =
      closer.find_loops([&](std::int64_t a, std::int64_t b) { return mapper.odometry(a, b); },
                        odometry.median_depth_m());
  for (const Loop& loop : loops) {
    mapper.add_loop(loop.query, loop.match, loop.T_match_query, loop.information);
    loops_waiting = true;
    ++result.loops_accepted;
  }
  ++keyframes_since_optimization;
  if (loops_waiting && keyframes_since_optimization >= options.optimize_interval) {
    refresh_links();
    optimize();
  }
}

void Slam::Impl::optimize() {
  const PoseGraphReport report = mapper.optimize(options.pose_graph, log_sink);
  if (!report.outcome)
    log(log_sink, LogLevel::kWarning, "place graph not optimized: " + report.outcome.reason);
  loops_waiting = false;
  keyframes_since_optimization = 0;
}

Map Slam::Impl::snapshot() const {
  Map map;
  map.place_graph = mapper.place_graph();
  for (Place& place : map.place_graph.places)
    for (const auto& view : closer.views())
      if (view.keyframe == place.anchor_keyframe) place.appearance = closer.describe(view.features);
  std::map<std::int64_t, SE3> T_place_keyframe;
  for (const Place& place : map.place_graph.places)
    for (const PlaceMember& member : place.members)
      T_place_keyframe[member.keyframe] = member.T_place_keyframe;
  for (const auto& view : closer.views()) {
    Keyframe keyframe;
    keyframe.id = view.keyframe;
    keyframe.frame = view.frame;
    keyframe.stamp_ns = stamp_of_keyframe.at(view.keyframe);
    keyframe.place = mapper.place_of(view.keyframe);
    keyframe.T_place_keyframe = T_place_keyframe.at(view.keyframe);
    keyframe.features = view.features;
    map.keyframes.push_back(std::move(keyframe));
  }
  map.landmarks = odometry.landmarks();
  map.frames = records;
  map.loops = closer.records();
  map.metric = odometry.scale_known();
  map.trajectory_online = online;
  return map;
}

}  // namespace placegraph
