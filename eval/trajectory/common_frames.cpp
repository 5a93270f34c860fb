#include <placegraph/eval/association/nominal_spacing.h>
#include <placegraph/eval/trajectory/common_frames.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <limits>

namespace placegraph {
namespace {

constexpr double kNearShare = 0.75;  // as for lost frames of a single estimate
// Before the first pose and behind the last one none is missing for nearly a whole spacing. Chosen.
constexpr double kEndShare = 0.9;

/// The stamps at which an estimate is posed.
class PosedTimes {
 public:
  explicit PosedTimes(const std::vector<FramePair>& pairs) {
    for (const FramePair& pair : pairs)
      if (pair.T_world_estimate) stamps_ns_.push_back(pair.stamp_ns);
    spacing_ns_ = nominal_spacing_ns(stamps_ns_);
  }

  bool covers(std::int64_t stamp_ns) const {
    const auto after = std::lower_bound(stamps_ns_.begin(), stamps_ns_.end(), stamp_ns);
    const bool first = after == stamps_ns_.begin(), last = after == stamps_ns_.end();
    double distance_ns = std::numeric_limits<double>::infinity();
    if (!last) distance_ns = static_cast<double>(*after - stamp_ns);
    if (!first)
      distance_ns = std::min(distance_ns, static_cast<double>(stamp_ns - *std::prev(after)));
    return distance_ns <= (first || last ? kEndShare : kNearShare) * spacing_ns_;
  }

 private:
  std::vector<std::int64_t> stamps_ns_;
  double spacing_ns_ = 0;
};

}  // namespace

CommonResult on_common_frames(const std::vector<PairingResult>& paired,
                              const std::vector<std::string>& names,
                              const EvaluationOptions& options) {
  require(paired.size() == names.size(), "common frames: as many names as pairings");
  std::vector<PosedTimes> times;
  for (const PairingResult& each : paired)
    if (each.outcome) times.emplace_back(each.pairs);
  CommonResult common;
  if (times.size() < 2) return common;
  std::vector<PairingResult> kept = paired;
  for (PairingResult& each : kept) {
    each.warnings.clear();
    if (!each.outcome) continue;
    for (FramePair& pair : each.pairs) {
      const bool everywhere = std::all_of(times.begin(), times.end(), [&](const PosedTimes& other) {
        return other.covers(pair.stamp_ns);
      });
      if (!pair.T_world_estimate || everywhere) continue;
      pair.T_world_estimate.reset();
      --each.posed;
      common.needed = true;
    }
    if (each.posed < 2)
      each.outcome = Outcome::failure(Outcome::Code::kTooFewData,
                                      "the estimates have no two frames in common");
  }
  if (!common.needed) return common;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    common.results.push_back(evaluate(std::move(kept[i]), options, names[i]));
    common.results.back().warnings.clear();  // said of the estimate's own frames already
  }
  return common;
}

}  // namespace placegraph
