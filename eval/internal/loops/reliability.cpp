#include <placegraph/eval/internal/loops/reliability.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>

namespace placegraph {

Reliability reliability_of(const std::vector<ScoredPrediction>& answers) {
  constexpr int kBins = 10;
  Reliability result;
  result.bins.resize(kBins);
  for (const ScoredPrediction& answer : answers) {
    require(answer.score >= 0 && answer.score <= 1, "reliability_of: a score is no probability");
    const int at = std::min(kBins - 1, static_cast<int>(kBins * answer.score));
    ReliabilityBin& bin = result.bins[static_cast<std::size_t>(at)];
    ++bin.answers;
    bin.mean_probability += answer.score;
    bin.share_right += answer.correct;
  }
  for (ReliabilityBin& bin : result.bins) {
    if (bin.answers == 0) continue;
    bin.mean_probability /= bin.answers;
    bin.share_right /= bin.answers;
    result.calibration_error += std::abs(bin.share_right - bin.mean_probability) * bin.answers /
                                static_cast<double>(answers.size());
  }
  return result;
}

}  // namespace placegraph
