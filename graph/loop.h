#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/geometry/sim3.h>

namespace [[gnu::visibility("default")]] placegraph {

/// A verified loop closure between two keyframes.
struct Loop {
  KeyframeId query, match;  ///< the later keyframe, and the earlier one that shows the same place
  SE3 T_match_query;        ///< pose of the query relative to the match, at the match's scale
  /// Information of S_match_query in its right tangent; if the scale was given, the information of
  /// T_match_query in the upper left 6x6 block and zero elsewhere.
  Matrix7d information = Matrix7d::Zero();
  double scale_match_query = 1;  ///< scale: lengths at the match over lengths at the query

  /// The measured similarity; rigid if the scale is 1.
  Sim3 S_match_query() const {
    return {T_match_query.rotation(), T_match_query.translation(), scale_match_query};
  }
};

}  // namespace placegraph
