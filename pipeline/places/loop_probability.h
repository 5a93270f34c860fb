#pragma once
#include <placegraph/graph/map.h>

#include <array>
#include <string_view>

namespace placegraph {

/// How probable it is that query and match of a record show one place, by the stage that decided,
/// how alike the views are, and how many points and lines agree with one pose: a logistic model
/// whose coefficients were fitted to candidates of rendered drives whose truth is known
/// (docs/places.md, tests/bench/loop_odds_study). Throws ArgumentError for an unknown stage.
double loop_probability(const LoopRecord& record);

/// What the model sees of a record.
struct LoopOddsCues {
  std::size_t fate = 0;  ///< index into kLoopFates
  /// Within bounds. Once a pose has been found, how alike the views are tells nothing more: 0.
  double log_likeness = 0;
  double log_agreeing = 0;  ///< of one and the points and lines that agree
};
LoopOddsCues loop_odds_cues(const LoopRecord& record);

/// What may have become of a candidate: the stages of LoopRecord, and "unreachable" for a drift
/// that was judged before anything was looked at.
inline constexpr std::array<std::string_view, 7> kLoopFates = {
    "retrieval", "unreachable", "geometry", "drift", "covariance", "support", "accepted"};

}  // namespace placegraph
