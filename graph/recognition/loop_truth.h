#pragma once
#include <placegraph/graph/core/ids.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Which images are candidates of a query.
enum class LoopProtocol {
  kUndecided,      ///< the source of the truth does not say it; see judge_loops
  kWithinDrive,    ///< older images of the query's own drive
  kQueryDatabase,  ///< images of another set, whose numbers have nothing to do with those of queries
};
/// Name of a protocol: "undecided", "within one drive" or "queries against a database".
std::string to_string(LoopProtocol protocol);

/// The true matches of one image among the candidates first..last.
struct LoopQuery {
  FrameId first;                      ///< first candidate
  FrameId last = FrameId::highest();  ///< last candidate
  std::vector<FrameId> matches;       ///< ascending; empty: any detection is false
};

/// Ground truth of place recognition: which images show the same place as a query.
struct LoopTruth {
  std::map<FrameId, LoopQuery> queries;  ///< true matches by the query image
  /// Whether images that are not listed have no true match, so that any detection there is false;
  /// otherwise detections there are not judged.
  bool unlisted_have_none = false;
  /// Within one drive: candidates less than this many images before the query are neither hits nor
  /// misses. 0: the ranges of the queries alone define the candidates.
  std::int64_t min_age = 0;
  LoopProtocol protocol = LoopProtocol::kUndecided;  ///< which images are candidates
};

/// The truth of a matrix of matches, row by row: row q is the query, column m the candidate.
///
/// With another number of columns than of rows it is of queries and a database, else undecided.
/// Throws ArgumentError unless the values are whole rows of `columns`.
LoopTruth loop_truth_of_matrix(const std::vector<bool>& matches, std::size_t columns);

}  // namespace placegraph
