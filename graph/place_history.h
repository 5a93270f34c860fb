#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/loop.h>
#include <placegraph/graph/pose_graph/constraint.h>

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// The measured motion to a keyframe from an earlier one.
/// Within a track segment the earlier keyframe is the previous one. The first keyframe of a track
/// segment may be linked to any earlier one, which joins the track segment to the map.
struct KeyframeLink {
  KeyframeId from;  ///< the earlier keyframe
  SE3 T_from_this;  ///< pose of this keyframe relative to `from`, at the scale of `from`
  Matrix6d information = Matrix6d::Zero();  ///< information of T_from_this in its right tangent
  ConstraintSource source = ConstraintSource::kOdometry;  ///< kOdometry within a track segment
  /// Standard deviation of the change of the log scale between the two keyframes.
  double sigma_log_scale = 0;
  double scale = 1;  ///< scale: lengths at `from` over lengths at this keyframe
};

/// History of the places of a map: the data that a resumed run needs besides the map.
struct PlaceHistory {
  /// A keyframe and its link to an earlier one.
  struct Keyframe {
    KeyframeId id;                     ///< id of the keyframe
    KeyframeId segment;                ///< anchor keyframe of the segment that it belongs to
    int track_segment = 0;             ///< number of its track segment, from 0
    std::optional<KeyframeLink> link;  ///< nothing for the first keyframe of a component
  };
  /// A stretch of keyframes within reach of its first one, the anchor keyframe.
  struct Segment {
    KeyframeId anchor;     ///< identifies the segment
    PlaceId place;         ///< the place that it belongs to
    Sim3 S_place_segment;  ///< pose and scale; identity for the first segment of the place
    Matrix7d covariance = Matrix7d::Zero();  ///< covariance of S_place_segment in its right tangent
    /// Covariance of the motion from the previous anchor keyframe.
    std::optional<Matrix6d> motion_covariance;
  };
  /// The data of a place besides its segments.
  struct Place {
    PlaceId id;                ///< id of the place in the place graph
    double reach = 0;          ///< radius within which keyframes join it, at the place's scale
    KeyframeId last_keyframe;  ///< its latest member
  };
  /// A motion between two anchor keyframes that another sensor measured.
  struct Motion {
    KeyframeId from, to;                     ///< the anchor keyframes
    SE3 T_from_to;                           ///< measured motion [m]
    Matrix6d covariance = Matrix6d::Zero();  ///< covariance of T_from_to in its right tangent
  };

  /// A younger place that was merged into an older one; stored so that this can be undone.
  struct Merged {
    KeyframeId anchor;  ///< anchor keyframe of the younger place
    /// By anchor keyframe: covariances of the segments of the younger place before the merger.
    std::map<KeyframeId, Matrix7d> covariance_of_segment;
  };

  std::vector<Keyframe> keyframes;  ///< by ascending id
  std::vector<Segment> segments;    ///< by ascending anchor keyframe
  std::vector<Place> places;        ///< by ascending id
  std::vector<Motion> motions;      ///< measurements of other sensors
  std::vector<Loop> loops;          ///< accepted loops, in order
  std::vector<Merged> merged;       ///< mergers in force, in the order in which they were made
  /// Anchor keyframes of places whose merger was undone; these places are not merged again.
  std::set<std::pair<KeyframeId, KeyframeId>> separated;
  std::int64_t founded = 0;          ///< places founded so far, merged ones included
  std::size_t judged_loops = 0;      ///< number of loops when mergers were last checked
  std::vector<bool> scale_measured;  ///< for every track segment: whether its scale is known
  double median_depth_m = 10;        ///< median depth of the scene at the last keyframe
  /// What the run has learned of images, camera and motion, from which the doubts of Slam::notes
  /// follow: bytes that only Slam reads. Empty: nothing is known.
  std::string evidence;
};

}  // namespace placegraph
