#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/loop_odds.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

// As tests/bench/loop_odds_study prints them.
constexpr std::array<double, kLoopStages.size()> kConstants = {-2, -2, -2, -1, 0, 2};
constexpr double kPerLogLikeness = 1, kPerLogAgreeing = 0.5;

}  // namespace

LoopOddsCues loop_odds_cues(const LoopRecord& record) {
  // Beyond these bounds hardly a candidate was seen, and nothing is known.
  constexpr double kLeastAlike = 0.03, kMostAlike = 2;
  const auto stage = std::find(kLoopStages.begin(), kLoopStages.end(), record.stage);
  require(stage != kLoopStages.end(), "loop_odds_cues: stage " + record.stage + " is unknown");
  return {static_cast<std::size_t>(stage - kLoopStages.begin()),
          std::log(std::clamp(record.likeness, kLeastAlike, kMostAlike)),
          std::log1p(std::max(0, record.inliers + record.lines))};
}

double loop_probability(const LoopRecord& record) {
  const LoopOddsCues cues = loop_odds_cues(record);
  const double log_odds = kConstants[cues.stage] + kPerLogLikeness * cues.log_likeness +
                          kPerLogAgreeing * cues.log_agreeing;
  return 1 / (1 + std::exp(-log_odds));
}

}  // namespace placegraph
