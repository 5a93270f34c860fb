#pragma once
#include <placegraph/eval/loops/precision_recall.h>

#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Predictions whose probabilities are in one tenth, and the share of right ones.
struct ReliabilityBin {
  int predictions = 0;          ///< their number
  double mean_probability = 0;  ///< 0 without predictions
  double share_right = 0;       ///< 0 without predictions
};

/// Agreement of predicted probabilities with the share of right predictions.
struct Reliability {
  std::vector<ReliabilityBin> bins;  ///< ten, from 0 to 1
  /// Mean of |share right - mean probability| over the predictions, by bins (Naeini et al. 2015); 0
  /// without predictions.
  double calibration_error = 0;
};

/// Computes the reliability of scores that are probabilities.
/// Throws ArgumentError for a score outside 0 to 1.
Reliability reliability_of(const std::vector<ScoredPrediction>& predictions);

}  // namespace placegraph
