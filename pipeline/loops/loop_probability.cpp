#include <placegraph/pipeline/loops/loop_probability.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace placegraph {
namespace {

// One per LoopStage, as printed by tests/bench/loop_probability_study.
constexpr std::array<double, kLoopStageCount> kConstants = {0,    -6.85, -1.25, 1.16,
                                                            1.23, 0.11,  2.03};
// Printed by the same study.
constexpr double kPerLogSimilarity = 6.53, kPerLogAgreeing = 0.54;

}  // namespace

LoopFeatures loop_features(const LoopRecord& record) {
  // Almost no candidate of the fit was outside these bounds.
  constexpr double kLeastSimilarity = 0.03, kMostSimilarity = 2;
  const bool posed = record.stage >= LoopStage::kDrift;
  return {record.stage,
          posed ? 0 : std::log(std::clamp(record.similarity, kLeastSimilarity, kMostSimilarity)),
          std::log1p(std::max(0, record.inliers + record.lines))};
}

double loop_probability(const LoopRecord& record) {
  const LoopFeatures features = loop_features(record);
  const double log_odds = kConstants[static_cast<std::size_t>(features.stage)] +
                          kPerLogSimilarity * features.log_similarity +
                          kPerLogAgreeing * features.log_agreeing;
  return 1 / (1 + std::exp(-log_odds));
}

}  // namespace placegraph
