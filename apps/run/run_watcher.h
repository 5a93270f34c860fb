#pragma once
#include <placegraph/graph/core/stage_times.h>
#include <placegraph/graph/image/frame.h>
#include <placegraph/pipeline/cues/frame_view.h>
#include <placegraph/pipeline/slam/slam_events.h>

#include <functional>
#include <string>
#include <vector>

namespace placegraph::apps {

/// Something that watches a run, and may halt it: all functions are called on the run's thread.
class RunWatcher : public SlamEvents {
 public:
  /// The run of a sequence begins with this number of frames.
  virtual void begin(const std::string& sequence, std::size_t frames) = 0;
  /// Called before each frame; returns when the frame may be processed, or when `stop` says true.
  virtual void await_permission(const std::function<bool()>& stop) = 0;
  /// Called after each frame, after its events.
  virtual void frame_seen(const Frame& frame, const FrameResult& result, const FrameView& view) = 0;
  /// Called after each frame with the CPU time of all stages so far.
  virtual void stages_measured(const std::vector<StageTimes::Stage>& stages) = 0;
};

/// Shows a run while it goes on, and its results afterwards.
class RunDisplay {
 public:
  virtual ~RunDisplay() = default;
  /// Receives what happens in the run.
  virtual RunWatcher& watcher() = 0;
  /// The run has ended, with its results in this folder; `verdict`: that of its judgement, empty if
  /// there is none. Returns when nobody looks at the results any more, or after a signal.
  virtual void finish(const std::string& folder, const std::string& verdict) = 0;
};

/// Passes the events of a run to several listeners, in their order.
class SlamEventsGroup : public SlamEvents {
 public:
  /// Adds a listener; not owned.
  void add(SlamEvents* listener) { listeners_.push_back(listener); }
  bool empty() const { return listeners_.empty(); }

  void run_began() override { pass(&SlamEvents::run_began); }
  void lens_found(const LensFound& lens) override { pass(&SlamEvents::lens_found, lens); }
  void frame_posed(const FrameResult& frame) override { pass(&SlamEvents::frame_posed, frame); }
  void frame_lost(const FrameResult& frame) override { pass(&SlamEvents::frame_lost, frame); }
  void keyframe_added(const KeyframeAdded& added) override {
    pass(&SlamEvents::keyframe_added, added);
  }
  void loop_accepted(const LoopRecord& loop) override { pass(&SlamEvents::loop_accepted, loop); }
  void loop_refused(const LoopRecord& loop) override { pass(&SlamEvents::loop_refused, loop); }
  void place_added(const PlaceAdded& place) override { pass(&SlamEvents::place_added, place); }
  void places_merged(const PlacesMerged& places) override {
    pass(&SlamEvents::places_merged, places);
  }
  void component_joined(const ComponentJoined& component) override {
    pass(&SlamEvents::component_joined, component);
  }
  void map_moved(const MapMoved& move) override { pass(&SlamEvents::map_moved, move); }

 private:
  template <class... Event>
  void pass(void (SlamEvents::*function)(const Event&...), const Event&... event) {
    for (SlamEvents* listener : listeners_) (listener->*function)(event...);
  }

  std::vector<SlamEvents*> listeners_;
};

}  // namespace placegraph::apps
