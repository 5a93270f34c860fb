#include <placegraph/eval/loops/reliability.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>

namespace placegraph {

Reliability reliability_of(const std::vector<ScoredPrediction>& predictions) {
  // Bins of a tenth. Chosen.
  constexpr int kBins = 10;
  Reliability result;
  result.bins.resize(kBins);
  for (const ScoredPrediction& prediction : predictions) {
    require(prediction.score >= 0 && prediction.score <= 1,
            "reliability_of: a score is no probability");
    const int at = std::min(kBins - 1, static_cast<int>(kBins * prediction.score));
    ReliabilityBin& bin = result.bins[static_cast<std::size_t>(at)];
    ++bin.predictions;
    bin.mean_probability += prediction.score;
    bin.share_right += prediction.correct;
  }
  for (ReliabilityBin& bin : result.bins) {
    if (bin.predictions == 0) continue;
    bin.mean_probability /= bin.predictions;
    bin.share_right /= bin.predictions;
    result.calibration_error += std::abs(bin.share_right - bin.mean_probability) * bin.predictions /
                                static_cast<double>(predictions.size());
  }
  return result;
}

}  // namespace placegraph
