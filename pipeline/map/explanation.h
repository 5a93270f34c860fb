#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/map.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// What a map tells of one frame.
struct Explanation {
  FrameId frame;
  std::int64_t stamp_ns = 0;
  bool posed = false;

  // Where it is; of a posed frame.
  std::optional<KeyframeId> keyframe;
  std::optional<PlaceId> place;
  std::vector<std::string> labels;  ///< of the place
  int component = 0;
  SE3 T_map_cam;
  double way_to_keyframe = 0;  ///< length of T_keyframe_frame, in the map's unit
  /// Of T_map_cam in its right tangent, the map's first place held: what the place graph knows of
  /// the place. What the frame may be off within it is not known any more. Nothing where the graph
  /// leaves directions open or estimates units of length beside poses.
  std::optional<Matrix6d> covariance;

  // How it knows.
  int inliers = 0;                         ///< landmarks it was posed by
  int features = 0;                        ///< of its keyframe, and ...
  int features_placed = 0;                 ///< ... those of known depth
  std::map<std::string, int> constraints;  ///< of its place, by source
  /// Candidates in which it or its keyframe is the query or, accepted ones, the match.
  std::vector<LoopRecord> loops;    ///< accepted
  std::vector<LoopRecord> refused;  ///< with the stage that refused them
};

/// Nothing if the map has no such frame.
std::optional<Explanation> explain_frame(const Map& map, FrameId frame);

}  // namespace placegraph
