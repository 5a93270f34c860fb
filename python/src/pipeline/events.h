#pragma once
#include <placegraph/graph/core/log.h>
#include <placegraph/pipeline/slam/slam_events.h>

#include "python/src/bindings.h"

namespace placegraph::python {

/// The event of SlamEvents::run_began, which carries nothing.
struct RunBegan {};

/// Passes every event to one Python function, as an object of the class of its kind.
class PythonEvents : public SlamEvents {
 public:
  explicit PythonEvents(nb::object function) : function_(std::move(function)) {}
  const nb::object& function() const { return function_; }
  /// Drops the function; later events are not reported.
  void clear() { function_.reset(); }

  void run_began() override { tell(RunBegan()); }
  void lens_found(const LensFound& lens) override { tell(lens); }
  void frame_posed(const FrameResult& frame) override { tell(frame); }
  void frame_lost(const FrameResult& frame) override { tell(frame); }
  void keyframe_added(const KeyframeAdded& keyframe) override { tell(keyframe); }
  void loop_accepted(const LoopRecord& loop) override { tell(loop); }
  void loop_refused(const LoopRecord& loop) override { tell(loop); }
  void place_added(const PlaceAdded& place) override { tell(place); }
  void places_merged(const PlacesMerged& places) override { tell(places); }
  void component_joined(const ComponentJoined& component) override { tell(component); }
  void map_moved(const MapMoved& move) override { tell(move); }

 private:
  template <class Event>
  void tell(const Event& event) {
    const nb::gil_scoped_acquire gil;
    if (function_.is_valid()) function_(nb::cast(event));
  }

  nb::object function_;
};

/// Passes messages to a function of Python, with their level as "debug", "info" or "warning"; an
/// empty sink for None. The function must outlive the sink.
LogSink log_sink(const nb::object& function);

/// Throws ArgumentError, which names the argument, for what is neither None nor callable.
void require_callable(const nb::object& function, const char* argument);

}  // namespace placegraph::python
