#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/map.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// What a map knows of one frame, and by what evidence.
struct Explanation {
  FrameId frame;              ///< the frame that was asked for
  std::int64_t stamp_ns = 0;  ///< its time
  bool posed = false;         ///< false: the frame is lost, fields up to `covariance` are empty

  // Where it is; of a posed frame.
  std::optional<KeyframeId> keyframe;  ///< the keyframe that its pose is relative to
  std::optional<PlaceId> place;        ///< the place of that keyframe
  std::vector<std::string> labels;     ///< labels of the place
  int component = 0;                   ///< of the place, after components that loops have joined
  SE3 T_map_cam;                       ///< pose of the (left) camera, through keyframe and place
  double way_to_keyframe = 0;          ///< distance of frame and keyframe, in the map's unit
  /// Covariance of T_map_cam in its right tangent, with the map's first place held fixed: that of
  /// the place in the place graph, moved to the frame. The error of the frame within the place is
  /// not part of it. Nothing where the graph leaves directions unobservable or estimates scales
  /// beside poses.
  std::optional<Matrix6d> covariance;

  // How it knows.
  int inliers = 0;                         ///< landmarks that it was posed by as it was tracked
  int features = 0;                        ///< features of its keyframe
  int features_placed = 0;                 ///< those of them whose depth is known
  std::map<std::string, int> constraints;  ///< number of constraints of its place, by their source
  std::vector<LoopRecord> loops;    ///< accepted, of which it or its keyframe is query or match
  std::vector<LoopRecord> refused;  ///< refused, of which it or its keyframe is the query
};

/// Explains the pose of a frame; nothing if the map has no such frame.
///
/// Factorizes the whole place graph once, for the covariance.
std::optional<Explanation> explain_frame(const Map& map, FrameId frame);

}  // namespace placegraph
