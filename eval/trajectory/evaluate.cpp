#include <fmt/format.h>
#include <placegraph/eval/alignment/alignment.h>
#include <placegraph/eval/alignment/vertical.h>
#include <placegraph/eval/trajectory/evaluate.h>
#include <placegraph/eval/trajectory/figure_intervals.h>
#include <placegraph/eval/trajectory/plausibility.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

// A scale further from 1 than this, that also explains half the error, is a wrong unit or a
// monocular estimate rather than drift.
constexpr double kScaleTolerance = 0.1;

bool usable(const AlignmentResult& alignment) { return alignment.outcome || alignment.rank == 1; }

void align_estimates(const AlignmentResult& alignment, std::vector<FramePair>& pairs) {
  for (FramePair& pair : pairs)
    if (pair.T_world_estimate) pair.T_world_estimate = alignment.apply(*pair.T_world_estimate);
}

Outcome needs_orientation(const char* what) {
  return Outcome::failure(Outcome::Code::kTooFewData,
                          std::string(what) + " needs orientations, but there are positions alone");
}

/// RPE, t_rel and r_rel: motions between frames, with the scale of the alignment only.
void judge_motions(const std::vector<FramePair>& pairs, bool has_times,
                   const EvaluationOptions& options, EvaluationResult& r) {
  const double scale = r.alignment.scale;
  const VerticalResult vertical = vertical_of(pairs, true, options.vertical);
  std::optional<Eigen::Vector3d> up;
  if (vertical.outcome) up = vertical.axis;
  r.rpe = relative_errors(pairs, has_times, {}, StepPairs::kConsecutive, scale, up);
  for (const Delta& delta : options.relative.deltas)
    r.relative.push_back(
        relative_errors(pairs, has_times, delta, options.relative.pairs, scale, up));
  r.segments = kitti_segments(pairs, has_times, options.segments, scale);
}

/// The same without orientations: nothing.
void judge_no_motions(const EvaluationOptions& options, EvaluationResult& r) {
  r.rpe.outcome = needs_orientation("RPE");
  r.segments.outcome = needs_orientation("a relative error");
  for (const Delta& delta : options.relative.deltas) {
    RelativeErrors steps;
    steps.delta = delta;
    steps.pairs = options.relative.pairs;
    steps.outcome = needs_orientation("RPE");
    r.relative.push_back(std::move(steps));
  }
}

/// Errors of the aligned poses, and where they lie.
void judge_poses(bool has_orientation, const EvaluationOptions& options, EvaluationResult& r) {
  const std::vector<FramePair>& pairs = r.aligned_pairs;
  Outcome rotation = has_orientation ? Outcome::ok() : needs_orientation("a rotation error");
  if (!r.alignment.free_axes.empty())
    rotation = Outcome::failure(Outcome::Code::kDegenerate,
                                "the alignment leaves the rotation about an axis arbitrary");
  r.ape = ape(pairs, projection_of(pairs, options.part), rotation);
  r.components = error_components(pairs, r.travelled_m, has_orientation, options.vertical);
  r.profile = error_profile(pairs, r.travelled_m, r.ape, r.rpe, r.has_times,
                            options.segments.frame_rate_hz);
  r.below = shares_below(pairs, r.travelled_m, r.ape, options.below);
  // Of a plane, the positions of a mirrored estimate fit as well, turned over.
  if (rotation && r.alignment.rank == 2 && r.ape.rotation_deg.median > 90)
    r.warnings.push_back(fmt::format(
        "the positions lie in a plane, in which a mirror image fits as well, turned over: the "
        "orientations are {:.0f} deg off",
        r.ape.rotation_deg.median));
}

std::string scale_warning(const std::vector<FramePair>& pairs, Alignment used) {
  if (used == Alignment::kSim3 || used == Alignment::kScale) return {};
  const AlignmentResult rigid = align(pairs, Alignment::kSe3);
  const AlignmentResult similar = align(pairs, Alignment::kSim3);
  if (!usable(rigid) || !usable(similar)) return {};
  const bool far =
      similar.scale > 0 && std::abs(std::log(similar.scale)) > std::log1p(kScaleTolerance);
  if (!far || similar.rmse_m > 0.5 * rigid.rmse_m) return {};
  return fmt::format(
      "the estimate looks mis-scaled: a scale of {:.4f} fits clearly better "
      "(--align sim3 or --align scale fit one)",
      similar.scale);
}

void add_warnings(EvaluationResult& r, const PairingResult& paired) {
  for (const std::string& doubt : r.alignment.doubts) r.warnings.push_back(doubt);
  const std::string scale = scale_warning(paired.pairs, r.protocol.alignment);
  if (!scale.empty()) r.warnings.push_back(scale);
  if (paired.has_orientation)
    for (const std::string& warning : convention_warnings(paired.pairs))
      r.warnings.push_back(warning);
  if (!r.segments.outcome) r.warnings.push_back("no t_rel and r_rel: " + r.segments.outcome.reason);
  if (!r.rpe.outcome) r.warnings.push_back("no RPE: " + r.rpe.outcome.reason);
  for (const RelativeErrors& steps : r.relative)
    if (!steps.outcome && paired.has_orientation)
      r.warnings.push_back("no RPE over " + text_of(steps.delta) + ": " + steps.outcome.reason);
  if (r.coverage < 0.5)
    r.warnings.push_back(fmt::format(
        "only {:.1f} % of the frames have an estimate: the figures cover these frames only",
        100 * r.coverage));
  if (r.judged < r.frames)
    r.warnings.push_back(
        fmt::format("the ground truth is denser than the estimate: {} of its {} "
                    "frames are judged",
                    r.judged, r.frames));
  const int none = r.estimate_without_truth - r.estimate_beside_nearer;
  if (none > 0)
    r.warnings.push_back(
        fmt::format("{} of the estimate's {} poses have no ground truth{}", none, r.estimate_frames,
                    r.protocol.association == Association::kTime
                        ? fmt::format(" within {:g} s", r.protocol.max_difference_s)
                        : " of the same number"));
  if (r.estimate_beside_nearer > 0)
    r.warnings.push_back(
        fmt::format("{} of the estimate's {} poses have a ground truth that a nearer pose uses",
                    r.estimate_beside_nearer, r.estimate_frames));
}

/// The alignment of the options; notes the vertical that it used.
AlignmentResult fit_alignment(const PairingResult& paired, const EvaluationOptions& options,
                              Protocol& protocol) {
  if (options.alignment != Alignment::kYaw)
    return align(paired.pairs, options.alignment, options.align_over);
  const VerticalResult vertical =
      vertical_of(paired.pairs, paired.has_orientation, options.vertical);
  AlignmentResult none;
  none.outcome = vertical.outcome;
  if (!vertical.outcome) return none;
  protocol.vertical = vertical.text;
  return align(paired.pairs, options.alignment, options.align_over, vertical.axis);
}

/// Which of the two has all its positions in one point; empty if neither.
std::string who_stands(const std::vector<FramePair>& pairs) {
  const Eigen::Isometry3d *first_truth = nullptr, *first_estimate = nullptr;
  double truth_m = 0, estimate_m = 0;
  for (const FramePair& pair : pairs) {
    if (!pair.T_world_estimate) continue;
    if (!first_truth) {
      first_truth = &pair.T_world_truth;
      first_estimate = &*pair.T_world_estimate;
    }
    const auto from = [](const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
      return (a.translation() - b.translation()).norm();
    };
    truth_m = std::max(truth_m, from(pair.T_world_truth, *first_truth));
    estimate_m = std::max(estimate_m, from(*pair.T_world_estimate, *first_estimate));
  }
  // A nanometre: rounding. Chosen.
  constexpr double kNoPath_m = 1e-9;
  if (estimate_m < kNoPath_m) return ": the estimate never moves";
  return truth_m < kNoPath_m ? ": the ground truth never moves" : "";
}

/// Length of the true path from the first posed frame to the last.
double posed_path_m(const std::vector<FramePair>& pairs, const std::vector<double>& travelled_m) {
  const auto posed = [](const FramePair& pair) { return pair.T_world_estimate.has_value(); };
  const auto first = std::find_if(pairs.begin(), pairs.end(), posed);
  const auto last = std::find_if(pairs.rbegin(), pairs.rend(), posed);
  if (first == pairs.end()) return 0;
  return travelled_m[static_cast<std::size_t>(pairs.rend() - last) - 1] -
         travelled_m[static_cast<std::size_t>(first - pairs.begin())];
}

}  // namespace

EvaluationResult evaluate(const Trajectory& truth, const Trajectory& estimate,
                          const EvaluationOptions& options, const std::string& name) {
  options.check();
  return evaluate(pair_trajectories(truth, estimate, options.association, options.time), options,
                  name);
}

EvaluationResult evaluate(PairingResult paired, const EvaluationOptions& options,
                          const std::string& name) {
  options.check();
  EvaluationResult r;
  r.name = name;
  r.protocol.alignment = options.alignment;
  r.protocol.align_over = options.align_over;
  r.protocol.association = paired.association;
  r.protocol.max_difference_s = options.time.max_difference_s;
  r.protocol.offset_s = options.time.offset_s;
  r.protocol.lengths_m = options.segments.lengths_m;
  r.protocol.step = options.segments.step;
  r.protocol.pairs = options.relative.pairs;
  r.frames = paired.truth_frames;
  r.judged = static_cast<int>(paired.pairs.size());
  r.posed = paired.posed;
  r.estimate_frames = paired.estimate_frames;
  r.estimate_without_truth = paired.estimate_without_truth;
  r.estimate_beside_nearer = paired.estimate_beside_nearer;
  r.outcome = paired.outcome;
  r.has_times = paired.has_times;
  const bool by_first_pose =
      options.alignment == Alignment::kOrigin || options.alignment == Alignment::kScale;
  if (r.outcome && by_first_pose && !paired.has_orientation)
    r.outcome = needs_orientation(("align " + to_string(options.alignment)).c_str());
  if (r.outcome && options.align_over.unit == AlignmentSpan::Unit::kSeconds && !paired.has_times)
    r.outcome = Outcome::failure(Outcome::Code::kInconsistent,
                                 "an alignment over " + to_string(options.align_over) +
                                     " needs times, which these trajectories do not have");
  if (!r.outcome) return r;
  r.warnings = std::move(paired.warnings);

  for (const FramePair& pair : paired.pairs)
    if (!pair.T_world_estimate) r.lost_frames.push_back(pair.frame);
  r.coverage = static_cast<double>(r.posed) / r.judged;
  r.travelled_m = travelled_m(paired.pairs);
  r.path_m = r.travelled_m.back();
  r.posed_path_m = posed_path_m(paired.pairs, r.travelled_m);

  r.protocol.part = projection_of(paired.pairs, options.part).text;
  r.alignment = fit_alignment(paired, options, r.protocol);
  if (!usable(r.alignment)) {
    r.outcome = r.alignment.outcome;
    if (r.outcome.code == Outcome::Code::kDegenerate) r.outcome.reason += who_stands(paired.pairs);
    return r;
  }
  if (paired.has_orientation)
    judge_motions(paired.pairs, paired.has_times, options, r);
  else
    judge_no_motions(options, r);
  add_warnings(r, paired);
  const bool has_orientation = paired.has_orientation;
  r.aligned_pairs = std::move(paired.pairs);
  align_estimates(r.alignment, r.aligned_pairs);
  judge_poses(has_orientation, options, r);
  if (options.intervals) r.intervals = intervals_of_drive(r);
  return r;
}

}  // namespace placegraph
