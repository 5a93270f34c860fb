#include <fmt/format.h>
#include <placegraph/eval/association/nominal_spacing.h>
#include <placegraph/eval/association/pairing.h>
#include <placegraph/eval/association/stamp_shift.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/median.h>
#include <placegraph/graph/measurements/stamp_plausibility.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace placegraph {
namespace {

/// Above this ratio of line rates the ground truth counts as denser than the estimate.
constexpr double kDenserRatio = 1.5;
/// Nearer to a pose of the estimate than this share of its spacing, a frame is not lost.
constexpr double kNearShare = 0.75;

std::string seconds_text(double ns) {
  char text[48];
  std::snprintf(text, sizeof text, "%.3f", ns * 1e-9);
  return text;
}

double median_gap_ns(const Trajectory& trajectory) {
  std::vector<double> gaps_ns;
  for (std::size_t i = 1; i < trajectory.size(); ++i)
    gaps_ns.push_back(
        static_cast<double>(trajectory.poses[i].stamp_ns - trajectory.poses[i - 1].stamp_ns));
  return gaps_ns.empty() ? 0 : median_of(std::move(gaps_ns));
}

std::vector<std::int64_t> stamps_of(const Trajectory& trajectory) {
  std::vector<std::int64_t> stamps_ns;
  for (const StampedPose& pose : trajectory.poses) stamps_ns.push_back(pose.stamp_ns);
  return stamps_ns;
}

/// What is odd about the times of a trajectory; empty if nothing is.
std::string odd_times(const Trajectory& trajectory, const char* whose) {
  if (!trajectory.has_times) return {};
  const std::string odd = odd_spacing(stamps_of(trajectory), "pose");
  return odd.empty() ? odd : std::string(whose) + " has " + odd;
}

Outcome why_not_by_index(const Trajectory& truth, const Trajectory& estimate) {
  if (truth.size() == estimate.size() || truth.numbered || estimate.numbered) return Outcome::ok();
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
  if (first <= truth_last + slack_ns && last >= truth_first - slack_ns) return Outcome::ok();
  const std::string clock = other_clock(stamps_of(truth), stamps_of(estimate), "the estimate");
  return Outcome::failure(Outcome::Code::kInconsistent,
                          "the stamps do not overlap: ground truth " + seconds_text(truth_first) +
                              " to " + seconds_text(truth_last) + " s, estimate " +
                              seconds_text(first) + " to " + seconds_text(last) + " s" +
                              (clock.empty() ? "" : "; " + clock));
}

/// The holes in the times of the ground truth, in words; empty if there is none.
std::string holes_text(const Trajectory& truth) {
  // Far more than a dropped frame or two. Chosen.
  constexpr double kHole = 5;
  if (!truth.has_times) return {};
  const double median_ns = median_gap_ns(truth);
  int holes = 0;
  double all_ns = 0, longest_ns = 0, longest_at_ns = 0;
  for (std::size_t i = 1; i < truth.size(); ++i) {
    const auto from_ns = static_cast<double>(truth.poses[i - 1].stamp_ns);
    const double gap_ns = static_cast<double>(truth.poses[i].stamp_ns) - from_ns;
    if (gap_ns <= kHole * median_ns) continue;
    ++holes;
    all_ns += gap_ns;
    if (gap_ns > longest_ns) longest_ns = gap_ns, longest_at_ns = from_ns;
  }
  if (holes == 0) return {};
  return fmt::format(
      "the ground truth has {} of {} s in all, where nothing is judged: the longest lasts {} s from "
      "{} s on",
      holes == 1 ? "a hole" : fmt::format("{} holes", holes), seconds_text(all_ns),
      seconds_text(longest_ns), seconds_text(longest_at_ns));
}

/// How many of the posed stamps lie in the time that the other trajectory covers.
int stamps_within(const Trajectory& trajectory, const Trajectory& other, double offset_ns,
                  double slack_ns) {
  const double first = static_cast<double>(other.poses.front().stamp_ns) - slack_ns;
  const double last = static_cast<double>(other.poses.back().stamp_ns) + slack_ns;
  int within = 0;
  for (const StampedPose& pose : trajectory.poses) {
    const double stamp = static_cast<double>(pose.stamp_ns) + offset_ns;
    within += pose.T_world_body && stamp >= first && stamp <= last;
  }
  return within;
}

/// Refuses a pairing by time in which most poses of both find no partner.
Outcome why_few_pairs(const Trajectory& truth, const Trajectory& estimate, int paired,
                      const AssociationOptions& options) {
  if (truth.poses.empty() || estimate.poses.empty()) return Outcome::ok();
  const double offset_ns = options.offset_s * 1e9, slack_ns = options.max_difference_s * 1e9;
  const int of_truth = stamps_within(truth, estimate, -offset_ns, slack_ns);
  const int of_estimate = stamps_within(estimate, truth, offset_ns, slack_ns);
  if (2 * paired >= std::min(of_truth, of_estimate)) return Outcome::ok();
  std::vector<std::int64_t> shifted_ns = stamps_of(estimate);
  for (std::int64_t& stamp : shifted_ns) stamp += std::llround(offset_ns);
  const auto shift =
      constant_shift_that_pairs(stamps_of(truth), shifted_ns, options.max_difference_s);
  std::string remedy;
  if (shift)
    remedy = fmt::format("; {:+.4g} s on the estimate's stamps would pair {} (--offset {:.6g})",
                         shift->shift_s, shift->pairs, options.offset_s + shift->shift_s);
  return Outcome::failure(
      Outcome::Code::kInconsistent,
      fmt::format("most poses find no partner within {:g} s: {} pairs of {} poses of the ground "
                  "truth and {} of the estimate in the time that both cover{}",
                  options.max_difference_s, paired, of_truth, of_estimate, remedy));
}

/// Posed lines of the estimate without a partner whose nearest true pose is near enough.
int beside_nearer(const Trajectory& truth, const Trajectory& estimate,
                  const std::vector<int>& estimate_of, const AssociationOptions& options) {
  std::vector<bool> paired(estimate.size(), false);
  for (const int j : estimate_of)
    if (j >= 0) paired[static_cast<std::size_t>(j)] = true;
  const std::int64_t offset_ns = std::llround(options.offset_s * 1e9);
  const std::int64_t limit_ns = std::llround(options.max_difference_s * 1e9);
  int count = 0;
  std::size_t i = 0;
  for (std::size_t j = 0; j < estimate.size(); ++j) {
    const std::int64_t stamp_ns = estimate.poses[j].stamp_ns + offset_ns;
    while (i < truth.size() && truth.poses[i].stamp_ns < stamp_ns - limit_ns) ++i;
    if (i < truth.size() && !paired[j] && estimate.poses[j].T_world_body)
      count += truth.poses[i].stamp_ns <= stamp_ns + limit_ns;
  }
  return count;
}

/// Which frames of the ground truth without a partner are lost, and of those the ones to judge.
class LostFrames {
 public:
  LostFrames(const Trajectory& truth, const Trajectory& estimate, double offset_s)
      : gap_ns_(nominal_spacing_ns(stamps_of(estimate))),
        truth_gap_ns_(nominal_spacing_ns(stamps_of(truth))) {
    const std::int64_t offset_ns = std::llround(offset_s * 1e9);
    for (const StampedPose& pose : estimate.poses)
      if (pose.T_world_body) posed_ns_.push_back(pose.stamp_ns + offset_ns);
  }

  /// Notes a frame that has a partner; all frames are passed in the order of time.
  void paired(std::int64_t stamp_ns) { last_due_ns_ = stamp_ns; }

  /// Whether a frame without a partner is to be judged.
  bool judge(std::int64_t stamp_ns) {
    if (distance_ns(stamp_ns) < kNearShare * gap_ns_) return false;
    if (!last_due_ns_) {
      last_due_ns_ = stamp_ns;
      return true;
    }
    // Where the truth is denser, the frame nearest to the time at which the next pose is due.
    const double late_ns = static_cast<double>(stamp_ns - *last_due_ns_) - gap_ns_;
    if (gap_ns_ > kDenserRatio * truth_gap_ns_ && late_ns < -0.5 * truth_gap_ns_) return false;
    const bool behind_a_hole = late_ns > truth_gap_ns_;
    last_due_ns_ = behind_a_hole ? stamp_ns : *last_due_ns_ + std::llround(gap_ns_);
    return true;
  }

 private:
  double distance_ns(std::int64_t stamp_ns) const {
    const auto after = std::lower_bound(posed_ns_.begin(), posed_ns_.end(), stamp_ns);
    double distance = std::numeric_limits<double>::infinity();
    if (after != posed_ns_.end()) distance = static_cast<double>(*after - stamp_ns);
    if (after != posed_ns_.begin())
      distance = std::min(distance, static_cast<double>(stamp_ns - *std::prev(after)));
    return distance;
  }

  double gap_ns_, truth_gap_ns_;
  std::vector<std::int64_t> posed_ns_;       ///< of the estimate, in the time of the truth
  std::optional<std::int64_t> last_due_ns_;  ///< when the last judged pose was due
};

/// For every line of the ground truth the line of the estimate; -1: none.
std::vector<int> partners(const Trajectory& truth, const Trajectory& estimate, bool by_time,
                          const AssociationOptions& options) {
  std::vector<int> estimate_of(truth.size(), -1);
  if (by_time) {
    for (const auto& [i, j] : associate_by_time(truth, estimate, options))
      estimate_of[static_cast<std::size_t>(i)] = j;
  } else if (truth.numbered || estimate.numbered) {
    for (std::size_t i = 0, j = 0; i < truth.size() && j < estimate.size();) {
      const std::int64_t a = truth.poses[i].stamp_ns, b = estimate.poses[j].stamp_ns;
      if (a == b) estimate_of[i] = static_cast<int>(j);
      if (a <= b) ++i;
      if (b <= a) ++j;
    }
  } else {
    for (std::size_t i = 0; i < truth.size(); ++i) estimate_of[i] = static_cast<int>(i);
  }
  return estimate_of;
}

/// The frames to judge, with their estimates.
void add_pairs(const Trajectory& truth, const Trajectory& estimate,
               const std::vector<int>& estimate_of, LostFrames lost, PairingResult& result) {
  const bool by_time = result.association == Association::kTime;
  result.pairs.reserve(by_time ? std::min(truth.size(), estimate.size()) : truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (!truth.poses[i].T_world_body) continue;
    ++result.truth_frames;
    FramePair pair;
    pair.frame = static_cast<int>(i);
    pair.stamp_ns = truth.poses[i].stamp_ns;
    pair.T_world_truth = *truth.poses[i].T_world_body;
    if (estimate_of[i] >= 0)
      pair.T_world_estimate = estimate.poses[static_cast<std::size_t>(estimate_of[i])].T_world_body;
    if (estimate_of[i] >= 0)
      lost.paired(pair.stamp_ns);
    else if (by_time && !lost.judge(pair.stamp_ns))
      continue;
    result.posed += pair.T_world_estimate.has_value();
    result.pairs.push_back(pair);
  }
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

  for (const Trajectory* read : {&truth, &estimate})
    result.warnings.insert(result.warnings.end(), read->warnings.begin(), read->warnings.end());
  const std::vector<int> estimate_of = partners(truth, estimate, by_time, options);
  if (by_time) {
    const auto paired = std::count_if(estimate_of.begin(), estimate_of.end(),
                                      [](int partner) { return partner >= 0; });
    result.outcome = why_few_pairs(truth, estimate, static_cast<int>(paired), options);
    if (!result.outcome) return result;
    result.estimate_beside_nearer = beside_nearer(truth, estimate, estimate_of, options);
  }
  for (std::string odd :
       {odd_times(truth, "the ground truth"), odd_times(estimate, "the estimate"),
        holes_text(truth)})
    if (!odd.empty()) result.warnings.push_back(std::move(odd));
  result.has_times = truth.has_times;
  result.has_orientation = truth.has_orientation && estimate.has_orientation;
  add_pairs(truth, estimate, estimate_of, LostFrames(truth, estimate, options.offset_s), result);
  result.estimate_frames = static_cast<int>(estimate.posed());
  result.estimate_without_truth = result.estimate_frames - result.posed;
  if (result.posed < 2)
    result.outcome = Outcome::failure(
        Outcome::Code::kTooFewData,
        "only " + std::to_string(result.posed) + " of " + std::to_string(result.truth_frames) +
            " ground-truth frames have an estimate" +
            (by_time ? " within " + seconds_text(options.max_difference_s * 1e9) + " s" : ""));
  return result;
}

}  // namespace placegraph
