#include "apps/viewer/live_run.h"

#include <placegraph/pipeline/report/served_page.h>

#include <cmath>
#include <limits>

#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

using nlohmann::json;

/// A halted run that no browser shows for this time goes on.
constexpr std::chrono::seconds kAlone(20);
/// The newest places move with every keyframe: browsers need not follow each of these motions.
constexpr std::chrono::seconds kBetweenAnnouncements(1);
constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

template <class Value>
json column(const std::vector<Value>& values, int width = 1) {
  return json::parse(column_json(values, width));
}

const char* state_name(TrackingState state) {
  switch (state) {
    case TrackingState::kInitializing:
      return "initializing";
    case TrackingState::kTracking:
      return "tracking";
    case TrackingState::kLost:
      return "lost";
  }
  return "";
}

/// x y z qx qy qz qw.
std::array<double, 7> numbers_of(const SE3& T) {
  const Eigen::Quaterniond q = T.rotation().quaternion();
  const Eigen::Vector3d& t = T.translation();
  return {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()};
}

json loop_json(const LoopRecord& loop) {
  return {{"query_frame", loop.query_frame.value()}, {"match_frame", loop.match_frame.value()},
          {"stage", to_string(loop.stage)},          {"accepted", loop.accepted()},
          {"probability", loop.probability},         {"inliers", loop.inliers}};
}

json positions_json(const std::vector<Eigen::Vector3d>& points) {
  std::vector<float> values;
  for (const Eigen::Vector3d& p : points)
    for (int i = 0; i < 3; ++i) values.push_back(static_cast<float>(p[i]));
  return column(values, 3);
}

json frames_json(const std::vector<LiveMap::TrackedFrame>& frames) {
  std::vector<std::int32_t> ids, components, inliers;
  std::vector<std::uint8_t> keyframes;
  std::vector<std::string> states;
  std::vector<float> poses;
  for (const LiveMap::TrackedFrame& frame : frames) {
    ids.push_back(static_cast<std::int32_t>(frame.frame.value()));
    components.push_back(frame.component);
    inliers.push_back(frame.inliers);
    keyframes.push_back(frame.keyframe ? 1 : 0);
    states.emplace_back(state_name(frame.state));
    if (!frame.pose) {
      poses.insert(poses.end(), 7, kUnknown);
      continue;
    }
    for (const double number : numbers_of(*frame.pose)) poses.push_back(static_cast<float>(number));
  }
  return {{"id", column(ids)},
          {"component", column(components)},
          {"pose", column(poses, 7)},
          {"inliers", column(inliers)},
          {"state", json::parse(text_column_json(states))},
          {"keyframe", column(keyframes)}};
}

}  // namespace

/// Adds an event; the caller has locked.
void LiveRun::tell(const char* name, const json& data) {
  events_->add(name, data.dump(-1, ' ', false, json::error_handler_t::replace));
}

void LiveRun::begin(const std::string& /*sequence*/, std::size_t frames) {
  const std::lock_guard lock(mutex_);
  total_ = frames;
}

void LiveRun::await_permission(const std::function<bool()>& stop) {
  constexpr std::chrono::milliseconds kBetweenChecks(100);
  std::unique_lock lock(mutex_);
  auto watched = std::chrono::steady_clock::now();
  while (paused_ && steps_ == 0 && !stop()) {
    permission_.wait_for(lock, kBetweenChecks);
    const auto now = std::chrono::steady_clock::now();
    if (events_->readers() > 0) watched = now;
    if (now - watched < kAlone) continue;
    halt(false, 0);
    note("the page was closed: the run goes on");
  }
  if (steps_ > 0) --steps_;
}

void LiveRun::frame_seen(const Frame& frame, const FrameResult& result, const FrameView& view) {
  const std::lock_guard lock(mutex_);
  const std::vector<Eigen::Vector3d> added = map_.add_frame(result, view);
  frame_ = frame;
  view_ = view;
  last_ = {{"frame", frame.id.value()},
           {"index", map_.frame_count() - 1},
           {"total", total_},
           {"stamp_s", 1e-9 * static_cast<double>(frame.stamp_ns)},
           {"state", state_name(result.state)},
           {"component", result.component},
           {"inliers", result.inliers},
           {"confidence", result.confidence ? json(*result.confidence) : json()},
           {"pose", result.T_map_cam ? json(numbers_of(*result.T_map_cam)) : json()},
           {"keyframe", result.keyframe},
           {"reason", result.outcome.reason}};
  json event = last_;
  if (!added.empty()) event["landmarks"] = positions_json(added);
  tell("frame", event);
  announce_poses();
}

void LiveRun::stages_measured(const std::vector<StageTimes::Stage>& stages) {
  constexpr std::chrono::milliseconds kBetween(500);
  const auto now = std::chrono::steady_clock::now();
  if (now - stages_sent_ < kBetween) return;
  stages_sent_ = now;
  json data = json::array();
  for (const StageTimes::Stage& stage : stages)
    data.push_back({{"name", stage.name}, {"cpu_s", stage.cpu_s}, {"calls", stage.calls}});
  const std::lock_guard lock(mutex_);
  stages_ = std::move(data);
  tell("stages", stages_);
}

void LiveRun::run_began() {
  const std::lock_guard lock(mutex_);
  const bool again = map_.frame_count() > 0 || !loops_.empty();
  map_.clear();
  loops_.clear();
  last_ = json();
  moved_ = false;
  if (!again) return;
  tell("reset", json::object());
  began_ = events_->last();
}

void LiveRun::keyframe_added(const KeyframeAdded& keyframe) {
  const std::lock_guard lock(mutex_);
  map_.add_keyframe(keyframe);
}

void LiveRun::loop_decided(const LoopRecord& loop) {
  const std::lock_guard lock(mutex_);
  loops_.push_back(loop);
  tell("loop", loop_json(loop));
}

void LiveRun::loop_accepted(const LoopRecord& loop) { loop_decided(loop); }
void LiveRun::loop_refused(const LoopRecord& loop) { loop_decided(loop); }

void LiveRun::place_added(const PlaceAdded& place) {
  const std::lock_guard lock(mutex_);
  map_.add_place(place);
}

/// Announces new poses, if the last announcement is some time ago; the caller has locked.
void LiveRun::announce_poses() {
  const auto now = std::chrono::steady_clock::now();
  if (!moved_ || now - announced_at_ < kBetweenAnnouncements) return;
  moved_ = false;
  announced_at_ = now;
  tell("moved", json::object());
}

void LiveRun::places_merged(const PlacesMerged& places) {
  const std::lock_guard lock(mutex_);
  map_.merge(places);
}

void LiveRun::component_joined(const ComponentJoined& component) {
  const std::lock_guard lock(mutex_);
  map_.join(component);
  moved_ = true;
}

void LiveRun::map_moved(const MapMoved& move) {
  const std::lock_guard lock(mutex_);
  map_.move(move);
  moved_ = true;
}

void LiveRun::finish(const std::string& verdict) {
  const std::lock_guard lock(mutex_);
  finished_ = true;
  if (!verdict.empty()) verdict_ = verdict;
  tell("done", {{"verdict", verdict_}});
}

json LiveRun::state() const {
  json state;
  std::vector<LiveMap::TrackedFrame> frames;
  std::vector<Eigen::Vector3d> landmarks;
  {
    const std::lock_guard lock(mutex_);
    frames = map_.frames();
    landmarks = map_.landmarks();
    json loops = json::array();
    for (const LoopRecord& loop : loops_) loops.push_back(loop_json(loop));
    state = {{"number", events_->last()},  {"began", began_},   {"total", total_},
             {"done", map_.frame_count()}, {"paused", paused_}, {"finished", finished_},
             {"verdict", verdict_},        {"last", last_},     {"stages", stages_},
             {"loops", std::move(loops)}};
  }
  state["frames"] = frames_json(frames);
  state["landmarks"] = positions_json(landmarks);
  return state;
}

std::optional<json> LiveRun::image() const {
  Frame frame;
  FrameView view;
  {
    const std::lock_guard lock(mutex_);
    if (frame_.image.empty()) return std::nullopt;
    frame = frame_;
    view = view_;
  }
  std::vector<float> points, lines;
  for (const FrameView::Track& track : view.tracks) {
    points.push_back(static_cast<float>(track.px.x()));
    points.push_back(static_cast<float>(track.px.y()));
    points.push_back(track.px_projected
                         ? static_cast<float>((*track.px_projected - track.px).norm())
                         : kUnknown);
  }
  for (const FrameView::Line& line : view.lines) {
    for (const Eigen::Vector2d& end : {line.segment.start, line.segment.end})
      for (int i = 0; i < 2; ++i) lines.push_back(static_cast<float>(end[i]));
    lines.push_back(line.off_px ? static_cast<float>(*line.off_px) : kUnknown);
  }
  const Image& image = frame.image;  // tracks are those of the corrected image; the colours are not
  return json{{"frame", frame.id.value()},   {"image", jpeg_url(image)},
              {"width", image.cols},         {"height", image.rows},
              {"points", column(points, 3)}, {"lines", column(lines, 5)}};
}

/// Halts the run but for these steps, or lets it go on; the caller has locked.
void LiveRun::halt(bool halted, int steps) {
  paused_ = halted;
  steps_ = steps;
  tell("control", {{"paused", halted}});
  permission_.notify_all();
}

void LiveRun::pause(bool paused) {
  const std::lock_guard lock(mutex_);
  halt(paused, 0);
}

void LiveRun::step() {
  const std::lock_guard lock(mutex_);
  halt(true, steps_ + 1);
}

bool LiveRun::paused() const {
  const std::lock_guard lock(mutex_);
  return paused_;
}

}  // namespace placegraph::apps
