#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/core/stage_times.h>
#include <placegraph/graph/map.h>
#include <placegraph/graph/measurements/data_note.h>
#include <placegraph/graph/place_history.h>

namespace [[gnu::visibility("default")]] placegraph {

/// What a run reports besides its map.
struct RunRecord {
  std::vector<DataNote> notes;  ///< doubts about the images, the calibration and the motion
  /// Errors of the motion from the first place to the last one, if they are known.
  std::optional<OdometryError> odometry_error;
  std::vector<StageTime> stages;  ///< CPU time of the stages, of all passes of the run
};

/// Additions to a map under construction, and changes in it, since the last call.
struct MapChanges {
  /// A constraint of the place graph that is new, changed or, without a value, removed.
  /// (kind, number) identifies the constraint during its existence and orders the constraints.
  struct ConstraintChange {
    int kind = 0;             ///< first part of its key
    std::int64_t number = 0;  ///< second part of its key
    /// The present constraint; nothing: it was removed.
    std::optional<RelativePoseConstraint> constraint;
  };

  std::vector<Place> places;  ///< all places of the map, with members, without appearances
  std::vector<std::pair<PlaceId, Appearance>> appearances;  ///< new or changed appearances
  std::vector<ConstraintChange> constraints;                ///< new, changed or removed constraints
  /// Keyframes that are new or whose features have changed; their view and thumbnail are empty if
  /// unchanged, their observations are in `observations`. The places of all other keyframes are in
  /// `places`.
  std::vector<Keyframe> keyframes;
  /// All observations of keyframes that have new ones.
  std::vector<std::pair<KeyframeId, std::vector<LandmarkObservation>>> observations;
  std::size_t first_frame = 0;      ///< frames and online poses before this position are unchanged
  std::vector<FrameRecord> frames;  ///< from `first_frame` on
  std::vector<StampedPose> online;  ///< T_map_cam from `first_frame` on
  std::size_t first_landmark = 0;   ///< landmarks before this position are unchanged
  std::vector<PointLandmark> landmarks;  ///< from `first_landmark` on
  std::vector<LoopRecord> loops;         ///< all loops of the map
  PlaceHistory history;                  ///< the whole history of the map
  bool metric = false;                   ///< whether the scale of the map is known now
  RunRecord run;                         ///< what the run reports now; replaces the earlier record
};

}  // namespace placegraph
