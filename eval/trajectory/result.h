#pragma once
#include <placegraph/eval/trajectory/ape.h>
#include <placegraph/eval/trajectory/kitti_segments.h>
#include <placegraph/eval/trajectory/pairing.h>
#include <placegraph/eval/trajectory/rpe.h>
#include <placegraph/eval/trajectory/umeyama.h>

#include <optional>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// How the figures of a result were made: they do not travel without it.
struct Protocol {
  Alignment alignment = Alignment::kSe3;
  Association association = Association::kAuto;  ///< as used
  double max_difference_s = 0, offset_s = 0;     ///< of the association by time
  std::vector<double> lengths_m;
  int step = 0;
};

/// One estimate judged against one ground truth.
struct EvaluationResult {
  Outcome outcome;   ///< of the association and the alignment; without it no figure is meaningful
  std::string name;  ///< of the estimate, for tables and legends
  Protocol protocol;
  int frames = 0;                  ///< posed ones of the ground truth
  int judged = 0;                  ///< of those; see PairingResult::pairs
  int posed = 0;                   ///< judged frames with an estimate
  int estimate_frames = 0;         ///< posed ones of the estimate
  int estimate_without_truth = 0;  ///< of those
  double coverage = 0;             ///< share of the judged frames that are posed, 0 to 1
  std::vector<int> lost_frames;    ///< judged frames without an estimate, ground-truth indices
  double path_m = 0;               ///< length of the true path
  double posed_path_m = 0;         ///< of its part from the first posed frame to the last
  AlignmentResult alignment;
  ApeResult ape;
  RpeResult rpe;
  SegmentResult segments;
  std::vector<std::string> warnings;
  /// The judged frames, estimates aligned, and the distance travelled [m]: what plots show.
  std::vector<FramePair> aligned_pairs;
  std::vector<double> travelled_m;
};

/// A figure with its unit and how it was made.
struct Metric {
  std::string key;              ///< as in JSON: "t_rel_percent"
  std::string name;             ///< for people: "t_rel"
  std::string unit;             ///< "m", "%", "deg/100m", "deg", "" (a ratio)
  std::optional<double> value;  ///< nothing where the data allow none
  std::string protocol;         ///< one line
};

/// All figures of a result in a fixed order; of a failed one, without values.
std::vector<Metric> metrics(const EvaluationResult& result);

/// Of several sequences: every metric is the mean over the sequences that have it, and t_rel and
/// r_rel are given pooled too, the mean over all segments of all sequences, as the devkit averages.
struct AverageResult {
  int sequences = 0;  ///< with an outcome
  int segments = 0;   ///< pooled
  std::vector<Metric> means;
  Metric pooled_t_rel, pooled_r_rel;
};
AverageResult average(const std::vector<EvaluationResult>& results);

}  // namespace placegraph
