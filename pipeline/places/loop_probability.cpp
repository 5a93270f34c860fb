#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/places/loop_probability.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

// As tests/bench/loop_odds_study prints them.
constexpr std::array<double, kLoopFates.size()> kConstants = {0,    -6.85, -1.25, 1.16,
                                                              1.23, 0.11,  2.03};
constexpr double kPerLogLikeness = 6.53, kPerLogAgreeing = 0.54;

}  // namespace

LoopOddsCues loop_odds_cues(const LoopRecord& record) {
  // Beyond these bounds hardly a candidate was seen, and nothing is known.
  constexpr double kLeastAlike = 0.03, kMostAlike = 2;
  const bool unseen = record.stage == "drift" && record.model == LoopModel::kNone;
  const auto fate = std::find(kLoopFates.begin(), kLoopFates.end(),
                              unseen ? std::string_view("unreachable") : record.stage);
  require(fate != kLoopFates.end() && record.stage != "unreachable",
          "loop_odds_cues: stage " + record.stage + " is unknown");
  const bool posed = fate >= std::find(kLoopFates.begin(), kLoopFates.end(), "drift");
  return {static_cast<std::size_t>(fate - kLoopFates.begin()),
          posed ? 0 : std::log(std::clamp(record.likeness, kLeastAlike, kMostAlike)),
          std::log1p(std::max(0, record.inliers + record.lines))};
}

double loop_probability(const LoopRecord& record) {
  const LoopOddsCues cues = loop_odds_cues(record);
  const double log_odds = kConstants[cues.fate] + kPerLogLikeness * cues.log_likeness +
                          kPerLogAgreeing * cues.log_agreeing;
  return 1 / (1 + std::exp(-log_odds));
}

}  // namespace placegraph
