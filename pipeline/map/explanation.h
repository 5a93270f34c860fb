#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/map.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Location of one frame in a map, and the evidence for it.
struct Explanation {
  FrameId frame;              ///< frame that was requested
  std::int64_t stamp_ns = 0;  ///< time stamp of the frame
  bool posed = false;  ///< false: the frame is lost, and the fields up to `covariance` are empty

  // Location of a posed frame.
  std::optional<KeyframeId> keyframe;  ///< keyframe to which the frame's pose is relative
  std::optional<PlaceId> place;        ///< place of that keyframe
  std::vector<std::string> labels;     ///< labels of the place
  int component = 0;                ///< component of the place, after loops have joined components
  SE3 T_map_cam;                    ///< pose of the (left) camera, through keyframe and place
  double distance_to_keyframe = 0;  ///< from the frame, in the scale of the map
  /// Covariance of T_map_cam in its right tangent, with the first place of the map fixed: the
  /// covariance of the place in the place graph, transformed to the frame. The error of the frame
  /// within the place is not included. Nothing if the graph leaves directions unobservable or
  /// estimates scales in addition to poses.
  std::optional<Matrix6d> covariance;

  // Evidence for the location.
  int inliers = 0;          ///< landmarks that agreed with the pose when the frame was tracked
  int features = 0;         ///< features of the keyframe
  int features_placed = 0;  ///< features of the keyframe whose depth is known
  std::map<std::string, int> constraints;  ///< number of constraints of the place, by their source
  /// Accepted loops whose query or match is the frame or its keyframe.
  std::vector<LoopRecord> loops;
  std::vector<LoopRecord> refused;  ///< refused loops whose query is the frame or its keyframe
};

/// Explains the pose of a frame; returns nothing if the map has no such frame.
///
/// Factorizes the whole place graph once to compute the covariance.
std::optional<Explanation> explain_frame(const Map& map, FrameId frame);

}  // namespace placegraph
