#pragma once
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/run/run_watcher.h"
#include "apps/server/event_log.h"
#include "apps/viewer/live_map.h"

namespace placegraph::apps {

/// What a browser sees of a run that goes on, and its pause.
///
/// A change is made and its event added under one lock: the state with number N contains the events
/// up to number N and no later one, but for poses, which may be newer. A browser that has a state
/// and all later events knows the run.
///
/// The run's thread only notes what happened; pictures are encoded on the threads of the server,
/// when a browser asks for them. Functions of the server may be called on any thread.
class LiveRun : public RunWatcher {
 public:
  explicit LiveRun(std::shared_ptr<EventLog> events) : events_(std::move(events)) {}

  // By the run.
  void begin(const std::string& sequence, std::size_t frames) override;
  void await_permission(const std::function<bool()>& stop) override;
  void frame_seen(const Frame& frame, const FrameResult& result, const FrameView& view) override;
  void stages_measured(const std::vector<StageTimes::Stage>& stages) override;
  void run_began() override;
  void keyframe_added(const KeyframeAdded& keyframe) override;
  void loop_accepted(const LoopRecord& loop) override;
  void loop_refused(const LoopRecord& loop) override;
  void place_added(const PlaceAdded& place) override;
  void places_merged(const PlacesMerged& places) override;
  void component_joined(const ComponentJoined& component) override;
  void map_moved(const MapMoved& move) override;

  /// The run has ended; `verdict`: that of its judgement, empty if there is none.
  void finish(const std::string& verdict);

  // By the server.
  /// Everything of the run so far, with the number of the last event in it: live/state.json.
  nlohmann::json state() const;
  /// The newest image with its tracks: live/image.json; nothing before the first one.
  std::optional<nlohmann::json> image() const;
  /// Lets the run go on or halts it before its next frame.
  void pause(bool paused);
  /// Lets a halted run process one frame.
  void step();
  bool paused() const;

 private:
  void tell(const char* name, const nlohmann::json& data);
  void loop_decided(const LoopRecord& loop);
  void halt(bool halted, int steps);
  void announce_poses();

  std::shared_ptr<EventLog> events_;
  mutable std::mutex mutex_;  // held while a change is made and its event added
  std::condition_variable permission_;
  LiveMap map_;
  std::vector<LoopRecord> loops_;
  nlohmann::json last_, verdict_;  // event of the newest frame without its landmarks; null: none
  nlohmann::json stages_ = nlohmann::json::array();
  std::size_t total_ = 0;
  std::int64_t began_ = 0;  // number of the newest event "reset"; 0 before the first
  bool moved_ = false;      // whether poses have changed that are not announced
  std::chrono::steady_clock::time_point announced_at_{};
  bool finished_ = false, paused_ = false;
  int steps_ = 0;  // frames that a halted run may still process
  Frame frame_;    // the newest; its images are shared with the run
  FrameView view_;
  std::chrono::steady_clock::time_point stages_sent_{};
};

}  // namespace placegraph::apps
