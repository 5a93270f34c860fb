#pragma once
#include <placegraph/eval/alignment/umeyama.h>
#include <placegraph/eval/association/pairing.h>
#include <placegraph/eval/errors/ape.h>
#include <placegraph/eval/errors/error_profile.h>
#include <placegraph/eval/errors/kitti_segments.h>
#include <placegraph/eval/errors/relative_error.h>
#include <placegraph/eval/offsets/offset_estimation.h>
#include <placegraph/eval/uncertainty/confidence_interval.h>

#include <optional>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// The method of computation of the figures of a result; every report states it.
struct Protocol {
  Alignment alignment = Alignment::kSe3;         ///< transformation that was fitted
  AlignmentSpan align_over;                      ///< poses that it was fitted to
  std::string vertical;                          ///< the vertical that kYaw used
  std::string part;                              ///< part of the position errors; empty: all
  Association association = Association::kAuto;  ///< the one used, kIndex or kTime
  double max_difference_s = 0, offset_s = 0;     ///< options of the association by time
  std::vector<double> lengths_m;                 ///< SegmentOptions::lengths_m
  StepPairs pairs = StepPairs::kConsecutive;     ///< RelativeErrorOptions::pairs
  int step = 0;                                  ///< SegmentOptions::step
  std::string filters, truth_filters;  ///< steps applied to estimate and truth before; empty: none
  std::string offsets;                 ///< "body", "time" or "body,time" if removed; empty: none
};

/// The confidence interval of one figure.
struct FigureInterval {
  std::string key, name, unit;  ///< as Metric
  ConfidenceInterval interval;  ///< of this drive's errors, or of repeated runs
};

/// One estimated trajectory evaluated against one ground truth.
struct EvaluationResult {
  Outcome outcome;    ///< outcome of association and alignment; without it no figure is meaningful
  std::string name;   ///< name of the estimate, for tables and legends
  Protocol protocol;  ///< how the figures were computed
  int frames = 0;     ///< posed frames of the ground truth
  int judged = 0;     ///< evaluated frames among these, see PairingResult::pairs
  int posed = 0;      ///< evaluated frames with an estimate
  int estimate_frames = 0;         ///< posed frames of the estimate
  int estimate_without_truth = 0;  ///< those of them without a true pose
  int estimate_beside_nearer = 0;  ///< and of these, those whose true pose a nearer one uses
  double coverage = 0;             ///< share of the evaluated frames that are posed, 0 to 1
  std::vector<int> lost_frames;    ///< evaluated frames without an estimate, ground-truth indices
  double path_m = 0;               ///< length of the true path
  double posed_path_m = 0;    ///< length of the true path from the first posed frame to the last
  AlignmentResult alignment;  ///< the transformation that was fitted
  ApeResult ape;              ///< absolute errors after the alignment
  ErrorComponents components;  ///< position errors along, across and up the path
  RelativeErrors rpe;         ///< errors of the motion between consecutive frames
  std::vector<RelativeErrors> relative;  ///< over the steps of the options, in their order
  SegmentResult segments;     ///< t_rel and r_rel
  ErrorProfile profile;       ///< where the errors lie
  std::vector<ShareBelow> below;  ///< for the bounds of the options, in their order
  std::vector<FigureInterval> intervals;  ///< of the figures, if the options ask for them
  std::optional<OffsetEstimate> offsets;  ///< those of body and time, if they were estimated
  std::vector<std::string> warnings;     ///< one line each: a suspicious property and a remedy
  std::vector<FramePair> aligned_pairs;  ///< the evaluated frames, with aligned estimates
  bool has_times = false;                ///< their stamps are times, not indices
  std::vector<double> travelled_m;       ///< length of the true path up to each of them
};

/// A figure with its unit and its method of computation.
struct Metric {
  std::string key;              ///< key in JSON: "t_rel_percent"
  std::string name;             ///< name in texts: "t_rel"
  std::string unit;             ///< "m", "%", "deg/100m", "deg", "" (a ratio)
  std::optional<double> value;  ///< nothing if the data allow none
  std::string protocol;         ///< method of computation, one line
};

/// Whether a figure, by its key, is a share of the drive, of which more is better.
bool is_share_of_drive(const std::string& key);

/// The statistics of one kind of error of a result.
struct ErrorRow {
  std::string key;        ///< "position_m", "rotation_deg", "rpe_1s_trans_m"
  std::string name;       ///< in words: "position", "RPE over 1 s, translation"
  std::string unit;       ///< "m", "deg", ""
  Statistics statistics;  ///< of the errors
  bool with_sign = false; ///< the errors have signs, and their mean is a bias
};

/// All statistics of a result that the data allow, in a fixed order.
std::vector<ErrorRow> error_rows(const EvaluationResult& result);

/// All figures of a result in a fixed order; those of a failed one have no value.
std::vector<Metric> metrics(const EvaluationResult& result);

/// Averages over several sequences.
struct AverageResult {
  int sequences = 0;          ///< sequences whose outcome is ok
  int failed = 0;             ///< those that are not
  int segments = 0;           ///< number of segments of all sequences
  /// Mean of every metric over the sequences that have a value; none has one if a sequence failed:
  /// who fails at the hard ones would have the better mean.
  std::vector<Metric> means;
  std::vector<Metric> means_of_rest;  ///< the same over the sequences that did not fail
  /// Means over all segments of all sequences, as the KITTI devkit averages; no value if one failed.
  Metric pooled_t_rel, pooled_r_rel;
};
/// Averages the results of several sequences.
///
/// `missing` further sequences have no estimate at all, and count as failed.
AverageResult average(const std::vector<EvaluationResult>& results, int missing = 0);

}  // namespace placegraph
