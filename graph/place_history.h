#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/loop.h>
#include <placegraph/graph/pose_graph/constraint.h>

#include <map>
#include <optional>
#include <set>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// The measured motion to a keyframe from an earlier one.
/// Within a track segment that is the keyframe before; the first keyframe of a segment may be
/// linked to any earlier one, by which the segment is joined to the map.
struct KeyframeLink {
  KeyframeId from;                                        ///< the earlier keyframe
  SE3 T_from_this;                                        ///< in the unit of length of `from`
  Matrix6d information = Matrix6d::Zero();                ///< of T_from_this in its right tangent
  ConstraintSource source = ConstraintSource::kOdometry;  ///< kOdometry within a track segment
  /// Standard deviation of the logarithm by which the unit of length changed on the way.
  double sigma_log_scale = 0;
  double scale = 1;  ///< length at `from` of one unit of length at this keyframe
};

/// How the places of a map came about: what a resumed run needs beyond the map itself.
struct PlaceHistory {
  /// A keyframe and its link to an earlier one.
  struct Keyframe {
    KeyframeId id;                     ///< of the keyframe
    KeyframeId segment;                ///< anchor of the part that it belongs to
    int track_segment = 0;             ///< number of its track segment, from 0
    std::optional<KeyframeLink> link;  ///< nothing where a component began
  };
  /// A stretch of keyframes within reach of its first one, the anchor.
  struct Segment {
    KeyframeId anchor;                          ///< identifies the part
    PlaceId place;                              ///< the place that it belongs to
    Sim3 S_place_segment;                       ///< identity if the part founded the place
    Matrix7d covariance = Matrix7d::Zero();     ///< of S_place_segment in its right tangent
    std::optional<Matrix6d> motion_covariance;  ///< of the motion from the previous anchor
  };
  /// What is kept of a place besides its parts.
  struct Place {
    PlaceId id;                ///< as in the place graph
    double reach = 0;          ///< radius within which keyframes join it, in its unit of length
    KeyframeId last_keyframe;  ///< its latest member
  };
  /// A motion between two anchors that another sensor measured.
  struct Motion {
    KeyframeId from, to;                     ///< the anchors
    SE3 T_from_to;                           ///< [m]
    Matrix6d covariance = Matrix6d::Zero();  ///< of T_from_to in its right tangent
  };

  /// A younger place that was merged into an older one, so that the merger can be undone.
  struct Merged {
    KeyframeId anchor;  ///< of the younger place
    /// By anchor: the parts of the younger place, with the covariances that they had there.
    std::map<KeyframeId, Matrix7d> covariance_of_segment;
  };

  std::vector<Keyframe> keyframes;  ///< by ascending id
  std::vector<Segment> segments;    ///< by ascending anchor
  std::vector<Place> places;        ///< by ascending id
  std::vector<Motion> motions;      ///< by other sensors
  std::vector<Loop> loops;          ///< accepted ones, in order
  std::vector<Merged> merged;       ///< mergers that hold, in the order in which they were made
  /// Anchors of places whose merger was undone; they are not merged again.
  std::set<std::pair<KeyframeId, KeyframeId>> separated;
  std::int64_t founded = 0;          ///< places founded so far, merged ones included
  std::size_t judged_loops = 0;      ///< number of loops when mergers were last checked
  std::vector<bool> scale_measured;  ///< of every track segment: whether its lengths are metres
  double median_depth_m = 10;        ///< of the scene at the last keyframe
};

}  // namespace placegraph
