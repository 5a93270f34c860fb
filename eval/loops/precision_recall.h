#pragma once
#include <optional>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// One answer of a detector: how sure it is, and whether it is right.
struct ScoredAnswer {
  double score = 0;
  bool correct = false;
};

/// What is detected at one threshold.
struct PrecisionRecallPoint {
  double threshold = 0;  ///< answers of at least this score are taken
  int hits = 0, misses = 0;
  double precision = 0, recall = 0;
};

struct PrecisionRecall {
  std::vector<PrecisionRecallPoint> curve;  ///< threshold falling, recall not falling
  /// Sum over the curve of precision times the recall gained: no interpolation. Nothing where there
  /// is nothing to be found; so are the others.
  std::optional<double> average_precision;
  /// The largest recall at which no answer is false; 0 if the surest answer is.
  std::optional<double> recall_at_full_precision;
  std::optional<double> f1_max;
};

/// Sweeps the threshold over the answers' scores. Answers of equal score enter together, so that
/// their order plays no part. `positives`: how many there are to be found, at least as many as
/// answers are correct (ArgumentError otherwise, or for a score that is not finite).
PrecisionRecall precision_recall(std::vector<ScoredAnswer> answers, int positives);

}  // namespace placegraph
