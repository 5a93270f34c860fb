#pragma once
#include <placegraph/graph/core/ids.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// What a recognizer's scores are.
enum class ScoreKind {
  kSimilarity,  ///< larger is more certain
  kDistance,    ///< smaller is more certain
};
/// Name of a kind: "similarity" or "distance".
inline std::string to_string(ScoreKind kind) {
  return kind == ScoreKind::kDistance ? "distance" : "similarity";
}

/// A place recognizer's prediction that an image shows the same place as another one.
struct LoopPrediction {
  FrameId query;      ///< the image
  FrameId candidate;  ///< an older image of the same drive, or one of a database
  double score = 0;   ///< its certainty, comparable over all queries; see ScoreKind
  std::string stage;  ///< the test that refused it, or "accepted"; empty if unknown
  int line = 0;       ///< line of the file that it was read from; 0 if it was not read
};

}  // namespace placegraph
