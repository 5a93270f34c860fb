#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/pipeline/places/place_mapper.h>
#include <placegraph/pipeline/slam/slam_events.h>

#include <cstddef>
#include <map>
#include <set>
#include <vector>

namespace placegraph {

/// Reports changes of the place graph and of the loops to SlamEvents.
///
/// It compares the places with their previous state, so that the code that changes them does not
/// have to report the changes. Without a listener it does nothing.
class EventFeed {
 public:
  /// `events` may be null; it must outlive this object.
  explicit EventFeed(SlamEvents* events) : events_(events) {}

  /// Takes over places and loops that the listener already knows.
  void take_up(const PlaceMapper& mapper, const std::vector<LoopRecord>& loops);
  /// Reports a keyframe that was just added to `mapper`.
  void keyframe_added(KeyframeId keyframe, FrameId frame, const PlaceMapper& mapper);
  /// Reports places that are new, were merged, changed their component or moved. `scale`: factor
  /// applied to lengths because the scale has become known.
  void places_changed(const PlaceMapper& mapper, double scale = 1);
  /// Reports loop candidates that were decided since the last call; `records`: all records so far.
  void loops_decided(const std::vector<LoopRecord>& records);
  /// Reports the result of a frame.
  void frame_done(const FrameResult& frame);

 private:
  struct Known {
    KeyframeId anchor;
    SE3 T_map_place;
    double scale = 1;
    int component = 0;
  };
  using Places = std::map<PlaceId, Known>;
  static Places places_of(const PlaceMapper& mapper);

  SlamEvents* events_;
  Places places_;                  // places as last reported
  std::size_t records_ = 0;        // number of loops that were reported
  std::set<std::size_t> pending_;  // newest records that were reported as waiting for a second loop
};

}  // namespace placegraph
