#pragma once
#include <placegraph/frontend/places/place_view.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/map_changes.h>
#include <placegraph/pipeline/loops/loop_closer.h>
#include <placegraph/pipeline/odometry/odometry.h>
#include <placegraph/pipeline/places/place_mapper.h>
#include <placegraph/pipeline/slam/environment_monitor.h>
#include <placegraph/pipeline/slam/trajectory_recorder.h>

#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace placegraph {

/// Components of a running system from which a map is assembled.
struct MapSources {
  const Odometry& odometry;
  const LoopCloser& closer;
  PlaceMapper& mapper;
  TrajectoryRecorder& recorder;
  const EnvironmentMonitor& environments;
};

/// Assembles maps from the components of a running system: the whole map, or the changes since the
/// last call at a cost proportional to the changes.
class MapFeed {
 public:
  explicit MapFeed(const PlaceCueOptions& cues) : cues_(cues) {}

  /// Keeps the appearance and a thumbnail of a keyframe until take_changes() has reported them, and
  /// the colours of the landmarks that it shows. Keyframes are kept in colour if the first one is,
  /// otherwise in grey.
  void keep_view(KeyframeId keyframe, const Frame& frame, const LocalMap& map);
  /// Marks landmarks and views of keyframes to be reported again, because lengths have changed.
  void report_again();
  [[nodiscard]] Map snapshot(const MapSources& sources) const;
  [[nodiscard]] MapChanges take_changes(const MapSources& sources);
  /// Takes over a saved map; ids of new landmarks continue after the ids in it.
  void take_up(const Map& map, const LoopCloser& closer);

 private:
  Keyframe keyframe_of(const LoopCloser::View& view, const TrajectoryRecorder& recorder) const;
  std::vector<PointLandmark> landmarks(const Odometry& odometry, std::size_t first) const;
  std::vector<std::pair<KeyframeId, std::vector<LandmarkObservation>>> observations(
      const LocalMap& map, KeyframeId from) const;

  PlaceCueOptions cues_;
  std::map<KeyframeId, PlaceView> views_;         // keyframes that have not been reported
  std::map<KeyframeId, std::string> thumbnails_;  // keyframes that have not been reported
  std::map<LandmarkId, std::array<std::uint8_t, 3>> colours_;  // by the ids of the local map
  std::optional<bool> views_in_colour_;
  std::vector<PointLandmark> earlier_landmarks_;  // landmarks of a saved map
  std::map<KeyframeId, std::vector<LandmarkObservation>> earlier_observations_;  // the same
  std::int64_t first_landmark_id_ = 0;               // first id after those of the saved map
  std::set<PlaceId> described_places_;               // places whose appearance has been reported
  std::size_t first_view_ = 0, first_landmark_ = 0;  // first items that have not been reported
  KeyframeId first_observed_;   // first keyframe whose observations may have changed
  int reported_component_ = 0;  // component whose online poses have been reported
  // number of views on which the vocabulary of the reported appearances was trained
  std::size_t reported_training_ = 0;
};

}  // namespace placegraph
