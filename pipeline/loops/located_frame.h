#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/geometry/sim3.h>

namespace placegraph {

/// A frame whose pose is known relative to a keyframe; it need not be a keyframe itself.
struct LocatedFrame {
  KeyframeId match;
  SE3 T_match_query;  ///< pose of the frame, in the scale of the keyframe
  /// Information of T_match_query in its right tangent, in the upper left 6x6 block; zero
  /// elsewhere.
  Matrix7d information = Matrix7d::Zero();
};

}  // namespace placegraph
