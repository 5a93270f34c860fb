#pragma once
#include <placegraph/eval/trajectory/common_frames.h>
#include <placegraph/eval/trajectory/figure_intervals.h>

#include <placegraph/io/datasets/evaluated_files.h>

#include <string>
#include <vector>

namespace placegraph::apps {

/// Names of the alignments and of the associations, in the order of Alignment and Association.
const std::vector<std::string>& eval_alignments();
const std::vector<std::string>& eval_associations();
/// Names of the verticals and of the parts of errors, in the order of Vertical and ErrorPart.
const std::vector<std::string>& eval_verticals();
const std::vector<std::string>& eval_parts();

struct EvalArguments {
  std::string truth;  ///< true trajectory, folder of a KITTI sequence, or folder of trajectories
  std::vector<std::string> estimates;  ///< estimated trajectories, or one folder of them
  std::vector<std::string> times;  ///< files of times for KITTI trajectories: one for all, or one
                                   ///< for the truth and one for the estimates
  std::string apply, apply_truth;  ///< filters of the estimates and of the truth; empty: none
  std::string align = "se3";       ///< one of eval_alignments()
  std::string align_frames, align_seconds;  ///< spans A:B of the alignment; empty: none
  int align_first = 0;                      ///< number of poses it is fitted to; 0: all
  std::string vertical = "estimated";       ///< one of eval_verticals()
  std::string part = "space";               ///< one of eval_parts()
  std::vector<std::string> deltas;          ///< lengths of steps, as parse_delta reads them
  std::vector<std::string> below;           ///< bounds of errors, as parse_error_bounds() reads
  bool all_pairs = false;                   ///< a step begins at every pose
  bool repeated_runs = false;               ///< the estimates are runs of one system
  std::string associate = "auto";  ///< one of eval_associations()
  std::vector<std::string> estimated;  ///< offsets estimated first: "body", "time"
  EvaluationOptions options;       ///< alignment and association are chosen by the two names above
  std::string csv, latex, plot;    ///< files to write; empty: none
  /// Kinds of figures for `plot`, of evaluation_plot_names(); several go to files of their own, of
  /// which the names end in _KIND.
  std::vector<std::string> plot_kinds = {"overview"};
  std::string plot_settings;  ///< YAML of FigureSettings; empty: the figures' own style
  std::string map;            ///< under the overview, see read_ground_picture(); empty: none
  std::vector<double> map_corners_m;  ///< of `map`: lower left x, y, upper right x, y; empty: none
  std::string evo_results;            ///< archive of evo to write; empty: none
  std::string report;                 ///< page that the caller writes; empty: none
  bool force = false;                 ///< overwrite them
};

struct EvalResult {
  std::vector<EvaluationResult> results;  ///< one for each estimate
  bool folders = false;                   ///< true if the files of two folders were paired by name
  std::vector<FigureInterval> of_runs;    ///< of repeated runs, if the estimates are such
  /// Of each further estimate against the first, with intervals and without repeated runs.
  std::vector<std::vector<FigureComparison>> comparisons;
  int missing = 0;      ///< files of the folder of truths without an estimate
  CommonResult common;                    ///< the estimates on the frames that all of them have

  /// True if a single estimate was evaluated.
  bool single() const { return results.size() == 1 && !folders; }
  /// The first result without an outcome, or nullptr; with such a result no file is written.
  const EvaluationResult* refused() const;
};

/// Evaluates trajectories against the true ones: `placegraph eval trajectory`.
/// Writes the requested files if every estimate could be evaluated. Throws ArgumentError,
/// FileError.
EvalResult eval(const EvalArguments& arguments);

/// The options of the evaluation that the arguments name. Throws ArgumentError.
EvaluationOptions evaluation_options(const EvalArguments& arguments);

/// Evaluates one estimate against its truth, with filters and offsets as the arguments say.
/// Its pairs are added to `kept`, if that is not null. Throws as eval().
EvaluationResult evaluate_files(const EvaluatedFiles& files, const EvalArguments& arguments,
                                EvaluationOptions options,
                                std::vector<PairingResult>* kept = nullptr);

/// A single result in full, several results as a table.
std::string to_text(const EvalResult& result);
std::string to_json(const EvalResult& result);

}  // namespace placegraph::apps
