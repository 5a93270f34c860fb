#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/geometry/sim3.h>

namespace [[gnu::visibility("default")]] placegraph {

/// A verified loop closure between two keyframes.
struct Loop {
  KeyframeId query, match;  ///< the later keyframe, and the earlier one that shows the same place
  SE3 T_match_query;        ///< in the match's unit of length
  /// Information of S_match_query in its right tangent; where the scale was given, that of
  /// T_match_query in the upper left 6x6 block and zero elsewhere.
  Matrix7d information = Matrix7d::Zero();
  double scale_match_query = 1;  ///< length at the match of one unit of length of the query

  /// The measured similarity; rigid where the scale is 1.
  Sim3 S_match_query() const {
    return {T_match_query.rotation(), T_match_query.translation(), scale_match_query};
  }
};

}  // namespace placegraph
