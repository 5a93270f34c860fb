#pragma once
#include <optional>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// One answer of a detector: how sure it is, and whether it is right.
struct ScoredPrediction {
  double score = 0;      ///< larger is surer; finite
  bool correct = false;  ///< whether it is right
};

/// Precision and recall at one threshold of the score.
struct PrecisionRecallPoint {
  double threshold = 0;              ///< answers of at least this score are taken
  int hits = 0, misses = 0;          ///< right and wrong answers among those
  double precision = 0, recall = 0;  ///< hits / (hits + misses), hits / positives; 0 to 1
};

/// A precision-recall curve and its figures, which are nothing if there are no positives.
struct PrecisionRecall {
  std::vector<PrecisionRecallPoint> curve;  ///< threshold falling, recall not falling
  /// Sum over the curve of precision times the recall gained, without interpolation.
  std::optional<double> average_precision;
  /// The largest recall at which no answer is false; 0 if the surest answer is.
  std::optional<double> recall_at_full_precision;
  std::optional<double> f1_max;  ///< largest harmonic mean of precision and recall on the curve
};

/// Computes the precision-recall curve over the threshold on the answers' scores.
///
/// Answers of equal score enter together, so that their order plays no part. `positives` is the
/// number of right answers that exist. Throws ArgumentError if more answers than that are correct,
/// or a score is not finite. The curve is empty without answers.
PrecisionRecall precision_recall(std::vector<ScoredPrediction> answers, int positives);

}  // namespace placegraph
