#pragma once
#include <placegraph/frontend/internal/places/place_view.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/map_changes.h>
#include <placegraph/pipeline/internal/loops/loop_closer.h>
#include <placegraph/pipeline/internal/odometry/odometry.h>
#include <placegraph/pipeline/internal/places/place_mapper.h>
#include <placegraph/pipeline/internal/slam/environment_monitor.h>
#include <placegraph/pipeline/internal/slam/trajectory_recorder.h>

#include <map>
#include <optional>
#include <set>
#include <vector>

namespace placegraph {

/// The parts of a running system that a map is made of.
struct MapSources {
  const Odometry& odometry;
  const LoopCloser& closer;
  PlaceMapper& mapper;
  TrajectoryRecorder& recorder;
  const EnvironmentMonitor& environments;
};

/// Makes maps of the parts of a running system: the whole one, and what has changed since the last
/// call, at the cost of what is new.
class MapFeed {
 public:
  explicit MapFeed(const PlaceCueOptions& cues) : cues_(cues) {}

  /// Keeps how a keyframe looks until take_changes() has told it. All keyframes are kept in colour,
  /// or none, as the first.
  void keep_view(KeyframeId keyframe, const Frame& frame);
  /// Lengths have changed: landmarks and views of keyframes are told again.
  void tell_again();
  [[nodiscard]] Map snapshot(const MapSources& sources) const;
  [[nodiscard]] MapChanges take_changes(const MapSources& sources);
  /// Takes over a saved map; ids of new landmarks follow its own.
  void take_up(const Map& map, const LoopCloser& closer);

 private:
  Keyframe keyframe_of(const LoopCloser::View& view, const TrajectoryRecorder& recorder) const;
  std::vector<PointLandmark> landmarks(const Odometry& odometry, std::size_t first) const;

  PlaceCueOptions cues_;
  std::map<KeyframeId, PlaceView> views_;  // of keyframes that have not been told
  std::optional<bool> views_in_colour_;
  std::vector<PointLandmark> earlier_landmarks_;     // of a saved map
  std::int64_t first_landmark_id_ = 0;               // after theirs
  std::set<PlaceId> described_places_;               // whose appearance has been told
  std::size_t first_view_ = 0, first_landmark_ = 0;  // from here on nothing has been told
  std::size_t told_training_ = 0;  // views that the vocabulary of the told appearances is of
};

}  // namespace placegraph
