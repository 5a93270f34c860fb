#pragma once
#include <placegraph/eval/loops/precision_recall.h>

#include <vector>

namespace placegraph {

/// Answers whose probabilities lie in one tenth, and how many of them are right.
struct ReliabilityBin {
  int answers = 0;
  double mean_probability = 0, share_right = 0;  ///< 0 without answers
};

/// Whether answers are as often right as they say.
struct Reliability {
  std::vector<ReliabilityBin> bins;  ///< ten, from 0 to 1
  /// Mean of |share right - mean probability| over the answers, by bins (Naeini et al. 2015); 0
  /// without answers.
  double calibration_error = 0;
};

/// Scores are probabilities; throws ArgumentError for one outside 0 to 1.
Reliability reliability_of(const std::vector<ScoredPrediction>& answers);

}  // namespace placegraph
