#pragma once
#include <placegraph/graph/core/ids.h>

#include <cstdint>
#include <map>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Which images show the place of one image, among the candidates first..last.
struct LoopQuery {
  FrameId first;
  FrameId last = FrameId::highest();
  std::vector<FrameId> matches;  ///< ascending; empty: any detection is false
};

/// Which images of a set show the same place.
struct LoopTruth {
  std::map<FrameId, LoopQuery> queries;
  /// Whether images that are not listed have no true match (so that any detection there is false);
  /// else they are not judged.
  bool unlisted_have_none = false;
  /// Candidates younger than this are neither hits nor misses [images]; 0: the queries' ranges
  /// alone say who is a candidate.
  std::int64_t min_age = 0;
};

}  // namespace placegraph
