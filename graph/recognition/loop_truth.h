#pragma once
#include <placegraph/graph/core/ids.h>

#include <cstdint>
#include <map>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// The true matches of one image among the candidates first..last.
struct LoopQuery {
  FrameId first;                      ///< first candidate
  FrameId last = FrameId::highest();  ///< last candidate
  std::vector<FrameId> matches;       ///< ascending; empty: any detection is false
};

/// Ground truth of place recognition: which images of a sequence show the same place.
struct LoopTruth {
  std::map<FrameId, LoopQuery> queries;  ///< true matches by the query image
  /// Whether images that are not listed have no true match, so that any detection there is false;
  /// otherwise detections there are not judged.
  bool unlisted_have_none = false;
  /// Candidates less than this many images before the query are neither hits nor misses. 0: the
  /// ranges of the queries alone define the candidates.
  std::int64_t min_age = 0;
};

}  // namespace placegraph
