#include <placegraph/eval/trajectory/pairing.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cstdio>

namespace placegraph {
namespace {

// Above this ratio of line rates the ground truth counts as denser than the estimate.
constexpr double kDenserRatio = 1.5;

std::string seconds(double ns) {
  char text[48];
  std::snprintf(text, sizeof text, "%.3f", ns * 1e-9);
  return text;
}

double median_gap_ns(const Trajectory& trajectory) {
  std::vector<double> gaps_ns;
  for (std::size_t i = 1; i < trajectory.size(); ++i)
    gaps_ns.push_back(
        static_cast<double>(trajectory.poses[i].stamp_ns - trajectory.poses[i - 1].stamp_ns));
  if (gaps_ns.empty()) return 0;
  const auto middle = gaps_ns.begin() + static_cast<std::ptrdiff_t>(gaps_ns.size() / 2);
  std::nth_element(gaps_ns.begin(), middle, gaps_ns.end());
  return *middle;
}

Outcome why_not_by_index(const Trajectory& truth, const Trajectory& estimate) {
  if (truth.size() == estimate.size()) return Outcome::ok();
  return Outcome::failure(Outcome::Code::kInconsistent,
                          "association by index needs lines of the same number: the ground truth "
                          "has " +
                              std::to_string(truth.size()) + ", the estimate " +
                              std::to_string(estimate.size()) +
                              " (with times on both sides, as in .tum, they are paired by time)");
}

Outcome why_not_by_time(const Trajectory& truth, const Trajectory& estimate,
                        const AssociationOptions& options) {
  if (!truth.has_times || !estimate.has_times)
    return Outcome::failure(Outcome::Code::kInconsistent,
                            std::string("association by time needs times on both sides: the ") +
                                (truth.has_times ? "estimate" : "ground truth") +
                                " has none (give a times file, or associate by index)");
  if (truth.poses.empty() || estimate.poses.empty()) return Outcome::ok();
  const double offset_ns = options.offset_s * 1e9;
  const double slack_ns = options.max_difference_s * 1e9;
  const double first = static_cast<double>(estimate.poses.front().stamp_ns) + offset_ns;
  const double last = static_cast<double>(estimate.poses.back().stamp_ns) + offset_ns;
  const auto truth_first = static_cast<double>(truth.poses.front().stamp_ns);
  const auto truth_last = static_cast<double>(truth.poses.back().stamp_ns);
  if (first > truth_last + slack_ns || last < truth_first - slack_ns)
    return Outcome::failure(Outcome::Code::kInconsistent,
                            "the stamps do not overlap: ground truth " + seconds(truth_first) +
                                " to " + seconds(truth_last) + " s, estimate " + seconds(first) +
                                " to " + seconds(last) + " s");
  return Outcome::ok();
}

// Keeps the associated frames and, where the estimate has holes, one frame per missing one, so
// that holes still count as lost.
std::vector<FramePair> thin(const std::vector<FramePair>& pairs, double estimate_gap_ns) {
  std::vector<FramePair> kept;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (!pairs[i].T_world_estimate) {
      const auto since_ns = [&](std::int64_t from) {
        return static_cast<double>(pairs[i].stamp_ns - from);
      };
      if (!kept.empty() && since_ns(kept.back().stamp_ns) < estimate_gap_ns * 0.999) continue;
      // Not just before an associated one: it would be counted beside it.
      bool associated_soon = false;
      for (std::size_t j = i + 1; j < pairs.size(); ++j) {
        if (static_cast<double>(pairs[j].stamp_ns - pairs[i].stamp_ns) >= 0.5 * estimate_gap_ns)
          break;
        associated_soon |= pairs[j].T_world_estimate.has_value();
      }
      if (associated_soon) continue;
    }
    kept.push_back(pairs[i]);
  }
  return kept;
}

Association choose(Association wanted, const Trajectory& truth, const Trajectory& estimate,
                   Outcome& outcome) {
  outcome = Outcome::ok();
  if (wanted != Association::kAuto) return wanted;
  if (truth.has_times == estimate.has_times)
    return truth.has_times ? Association::kTime : Association::kIndex;
  outcome =
      Outcome::failure(Outcome::Code::kInconsistent,
                       std::string("only the ") + (truth.has_times ? "ground truth" : "estimate") +
                           " has times: give a times file for the other, or associate by "
                           "index");
  return wanted;
}

}  // namespace

std::string to_string(Association association) {
  switch (association) {
    case Association::kAuto:
      return "auto";
    case Association::kIndex:
      return "index";
    case Association::kTime:
      return "time";
  }
  throw ArgumentError("unknown association");
}

PairingResult pair_trajectories(const Trajectory& truth, const Trajectory& estimate,
                                Association association, const AssociationOptions& options) {
  PairingResult result;
  result.association = choose(association, truth, estimate, result.outcome);
  if (!result.outcome) return result;
  const bool by_time = result.association == Association::kTime;
  result.outcome =
      by_time ? why_not_by_time(truth, estimate, options) : why_not_by_index(truth, estimate);
  if (!result.outcome) return result;

  std::vector<int> estimate_of(truth.size(), -1);
  if (by_time)
    for (const auto& [i, j] : associate_by_time(truth, estimate, options))
      estimate_of[static_cast<std::size_t>(i)] = j;
  else
    for (std::size_t i = 0; i < truth.size(); ++i) estimate_of[i] = static_cast<int>(i);

  result.has_times = truth.has_times;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (!truth.poses[i].T_world_body) continue;
    FramePair pair;
    pair.frame = static_cast<int>(i);
    pair.stamp_ns = truth.poses[i].stamp_ns;
    pair.T_world_truth = *truth.poses[i].T_world_body;
    if (estimate_of[i] >= 0)
      pair.T_world_estimate = estimate.poses[static_cast<std::size_t>(estimate_of[i])].T_world_body;
    result.posed += pair.T_world_estimate.has_value();
    result.pairs.push_back(pair);
  }
  result.truth_frames = static_cast<int>(result.pairs.size());
  if (by_time && median_gap_ns(estimate) > kDenserRatio * median_gap_ns(truth)) {
    result.pairs = thin(result.pairs, median_gap_ns(estimate));
    result.thinned = true;
  }
  if (result.posed < 2)
    result.outcome = Outcome::failure(
        Outcome::Code::kTooFewData,
        "only " + std::to_string(result.posed) + " of " + std::to_string(result.truth_frames) +
            " ground-truth frames have an estimate" +
            (by_time ? " within " + seconds(options.max_difference_s * 1e9) + " s" : ""));
  return result;
}

}  // namespace placegraph
