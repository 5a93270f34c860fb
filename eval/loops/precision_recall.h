#pragma once
#include <optional>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// One prediction of a detector: its score and whether it is right.
struct ScoredPrediction {
  double score = 0;      ///< larger is more certain; finite
  bool correct = false;  ///< whether it is right
};

/// Precision and recall at one threshold of the score.
struct PrecisionRecallPoint {
  double threshold = 0;              ///< predictions of at least this score are accepted
  int hits = 0, misses = 0;          ///< right and wrong predictions among these
  double precision = 0, recall = 0;  ///< hits / (hits + misses), hits / positives; 0 to 1
};

/// A precision-recall curve and its figures; without positives the figures are empty.
struct PrecisionRecall {
  std::vector<PrecisionRecallPoint> curve;  ///< threshold descending, recall not descending
  /// Sum over the curve of precision times the recall gained, without interpolation.
  std::optional<double> average_precision;
  /// The largest recall at which no prediction is false; 0 if the most certain prediction is false.
  std::optional<double> recall_at_full_precision;
  std::optional<double> f1_max;  ///< largest harmonic mean of precision and recall on the curve
  /// The sum of average_precision over the recall of the right predictions alone, which ends at 1:
  /// scikit-learn's average_precision_score of these predictions. Nothing without a right one.
  std::optional<double> average_precision_of_answers;
  /// The area under the curve by trapezoids over that recall, from precision 1 at recall 0:
  /// VPR-Bench's AUC-PR (Zaffar et al. 2021). Nothing without a right prediction.
  std::optional<double> area_of_answers;
};

/// Computes the precision-recall curve over the threshold on the predictions' scores.
///
/// Answers of equal score are added together, so that their order has no influence. `positives` is
/// the number of right predictions that exist. Throws ArgumentError if more predictions than that
/// are correct, or a score is not finite. The curve is empty without predictions.
PrecisionRecall precision_recall(std::vector<ScoredPrediction> predictions, int positives);

}  // namespace placegraph
