#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/loop.h>
#include <placegraph/graph/pose_graph/constraint.h>

#include <map>
#include <optional>
#include <set>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// The motion to a keyframe from the one before it in the same run of tracking, or from where the
/// run hangs on an earlier one.
struct KeyframeLink {
  KeyframeId from;
  SE3 T_from_this;  ///< in the unit of `from`
  Matrix6d information = Matrix6d::Zero();
  ConstraintSource source = ConstraintSource::kOdometry;
  double sigma_log_scale = 0;  ///< how far the unit of length may have changed
  double scale = 1;            ///< length at `from` of one unit at this keyframe
};

/// How the places of a map came about, beyond what its PlaceGraph says of the outcome: what a run
/// that goes on has to know.
struct PlaceHistory {
  struct Keyframe {
    KeyframeId id;
    KeyframeId part;  ///< anchor of the stretch of keyframes that it belongs to
    int run = 0;      ///< of tracking
    std::optional<KeyframeLink> link;
  };
  /// A stretch of keyframes within reach of its first one, the anchor.
  struct Part {
    KeyframeId anchor;
    PlaceId place;
    Sim3 S_place_part;
    Matrix7d covariance = Matrix7d::Zero();     ///< of that, in its right tangent
    std::optional<Matrix6d> motion_covariance;  ///< of the motion from the previous anchor
  };
  struct Place {
    PlaceId id;
    double reach = 0;  ///< in its own unit
    KeyframeId last_keyframe;
  };
  /// Between two anchors, by other sensors.
  struct Motion {
    KeyframeId from, to;
    SE3 T_from_to;
    Matrix6d covariance = Matrix6d::Zero();
  };

  /// Parts that came into a place with a younger one, and what they knew of each other there.
  struct Merged {
    KeyframeId anchor;  ///< of the younger place
    std::map<KeyframeId, Matrix7d> covariance_of_part;
  };

  std::vector<Keyframe> keyframes;  ///< by ascending id, as the next two
  std::vector<Part> parts;
  std::vector<Place> places;
  std::vector<Motion> motions;
  std::vector<Loop> loops;
  std::vector<Merged> merged;                          ///< in the order it was done
  std::set<std::pair<KeyframeId, KeyframeId>> parted;  ///< anchors that are not one place
  std::int64_t founded = 0;                            ///< places so far, with those gone
  std::size_t judged_loops = 0;                        ///< that mergers were judged with
  std::vector<bool> unit_measured;                     ///< of every run of tracking
  double median_depth_m = 10;                          ///< of the scene at the last keyframe
};

}  // namespace placegraph
