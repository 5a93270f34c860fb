#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/geometry/sim3.h>
#include <placegraph/pipeline/cues/frame_view.h>
#include <placegraph/pipeline/slam/slam_events.h>

#include <map>
#include <optional>
#include <set>
#include <vector>

namespace placegraph::apps {

/// The trajectory and the landmarks of a run that goes on, from its events.
///
/// Poses of frames and positions of landmarks are kept relative to the newest place and move with
/// it. They are for drawing: the map of the run, which is written at its end, is more accurate.
class LiveMap {
 public:
  struct TrackedFrame {
    FrameId frame;
    TrackingState state = TrackingState::kInitializing;
    int inliers = 0;
    bool keyframe = false;
    int component = -1;       ///< -1: no pose
    std::optional<SE3> pose;  ///< T_map_cam, by the present poses of places
  };

  /// Forgets everything: the run begins again.
  void clear();
  void add_place(const PlaceAdded& place);
  void add_keyframe(const KeyframeAdded& keyframe);
  void merge(const PlacesMerged& places);
  void join(const ComponentJoined& component);
  void move(const MapMoved& moved);
  /// Adds a frame; with the landmarks that it shows, if it became a keyframe. Returns the positions
  /// of the landmarks that are new, in the map.
  std::vector<Eigen::Vector3d> add_frame(const FrameResult& result, const FrameView& view);

  std::size_t frame_count() const { return frames_.size(); }
  std::vector<TrackedFrame> frames() const;
  std::vector<Eigen::Vector3d> landmarks() const;

 private:
  struct PlaceState {
    Sim3 S_map_place;
    int component = 0;
  };
  struct FrameState {
    TrackedFrame tracked;  // without component and pose
    PlaceId place;
    std::optional<Sim3> S_place_frame;
  };
  struct LandmarkState {
    PlaceId place;
    Eigen::Vector3d point_place;
  };
  const PlaceState* place_of(PlaceId id) const;

  std::map<PlaceId, PlaceState> places_;
  std::vector<FrameState> frames_;
  std::vector<LandmarkState> landmarks_;
  std::set<LandmarkId> known_;  // landmarks of this run
  PlaceId newest_;              // place of the newest keyframe
};

}  // namespace placegraph::apps
