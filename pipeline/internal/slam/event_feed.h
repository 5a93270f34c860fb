#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/pipeline/internal/places/place_mapper.h>
#include <placegraph/pipeline/slam_events.h>

#include <cstddef>
#include <map>
#include <set>
#include <vector>

namespace placegraph {

/// Tells SlamEvents what has changed in the place graph and in the loops since it last looked.
///
/// It compares the places with those it has seen, so that whoever changes them need not tell it.
/// Without a listener it does nothing.
class EventFeed {
 public:
  /// `events` may be null; it must outlive this object.
  explicit EventFeed(SlamEvents* events) : events_(events) {}

  /// Takes places and loops as known to the listener.
  void take_up(const PlaceMapper& mapper, const std::vector<LoopRecord>& loops);
  /// Tells of a keyframe that `mapper` has just been given.
  void keyframe_added(KeyframeId keyframe, FrameId frame, const PlaceMapper& mapper);
  /// Tells of places that are new, were merged, changed their component or moved. `scale`: by which
  /// lengths were multiplied because their unit has become known.
  void places_changed(const PlaceMapper& mapper, double scale = 1);
  /// Tells of loop candidates that were decided since the last call; `records`: all that there
  /// were.
  void loops_decided(const std::vector<LoopRecord>& records);
  /// Tells what became of a frame.
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
  Places places_;                  // as they were told
  std::size_t records_ = 0;        // of loops that were told
  std::set<std::size_t> waiting_;  // the newest records that were told to wait for a second loop
};

}  // namespace placegraph
