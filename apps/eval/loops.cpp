#include "apps/eval/loops.h"

#include <fmt/format.h>
#include <placegraph/eval/loops/loop_protocol.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/text/csv_text.h>
#include <placegraph/graph/text/json_text.h>
#include <placegraph/io/trajectories/trajectory_file.h>
#include <placegraph/pipeline/report/loops_page.h>
#include <placegraph/pipeline/report/run_page.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "apps/support/output.h"
#include "apps/support/plot_file.h"

namespace placegraph::apps {
namespace {

using nlohmann::json;

/// The truth of a call, and what it was read from.
struct GivenTruth {
  LoopTruth truth;
  std::optional<Trajectory> poses;  ///< of the images of one drive
  std::optional<ImageSet> queries, database;
  std::string text;  ///< definition of a true match
};

std::string same_view_text(const SameView& same, bool has_headings) {
  if (!has_headings) return fmt::format("positions within {:g} m", same.radius_m);
  return fmt::format("poses within {:g} m and {:g} deg", same.radius_m, same.heading_deg);
}

void warn_of(const std::vector<Doubt>& doubts) {
  for (const Doubt& doubt : doubts) warn(doubt.text);
}

/// The true matches of one drive, from its poses.
void add_drive(const LoopsArguments& arguments, GivenTruth& given) {
  RevisitOptions revisit = arguments.revisit;
  revisit.min_age = arguments.min_age.value_or(revisit.min_age);
  given.poses = warned(read_trajectory(arguments.poses, {}, Orientation::kOptional));
  warn_of(heading_doubts(*given.poses, revisit.same));
  given.truth = loop_truth_from_poses(*given.poses, revisit);
  given.text = same_view_text(revisit.same, given.poses->has_orientation);
}

/// The true matches of two sets, from where their images were taken.
void add_sets(const LoopsArguments& arguments, GivenTruth& given) {
  const SameView& same = arguments.revisit.same;
  try {
    put_in_one_frame(*given.database, *given.queries);
  } catch (const ArgumentError& error) {
    throw FileError(arguments.queries, error.what());
  }
  const bool headings =
      given.queries->poses.has_orientation && given.database->poses.has_orientation;
  Trajectory both = given.database->poses;
  both.has_orientation = headings;
  warn_of(heading_doubts(both, same));
  given.truth = loop_truth_between(given.queries->poses, given.database->poses, same);
  given.text = fmt::format("{} ({})", same_view_text(same, headings), given.queries->form);
}

/// The true matches of a file.
void add_listed(const LoopsArguments& arguments, GivenTruth& given) {
  LoopTruthFile file = read_loop_truth(arguments.truth);
  LoopProtocolChoice choice;
  choice.min_age = arguments.min_age;
  if (given.queries || given.database) choice.within = false;
  if (arguments.within) choice.within = true;
  try {
    choose_protocol(file.truth, choice, arguments.revisit.min_age);
  } catch (const ArgumentError& error) {
    throw FileError(arguments.truth, error.what());
  }
  given.truth = std::move(file.truth);
  given.text = file.form;
}

GivenTruth truth_of(const LoopsArguments& arguments) {
  GivenTruth given;
  if (!arguments.queries.empty()) given.queries = read_image_set(arguments.queries);
  if (!arguments.database.empty()) given.database = read_image_set(arguments.database);
  if (!arguments.truth.empty())
    add_listed(arguments, given);
  else if (!arguments.poses.empty())
    add_drive(arguments, given);
  else
    add_sets(arguments, given);
  return given;
}

/// The protocol as it was decided by the predictions, in words.
std::string protocol_text(const LoopsArguments& arguments, const GivenTruth& given,
                          LoopProtocol protocol) {
  std::string text = fmt::format("{}: {}", to_string(protocol), given.text);
  if (protocol == LoopProtocol::kWithinDrive && given.truth.min_age > 0)
    text += fmt::format(", candidates at least {} images older", given.truth.min_age);
  if (arguments.tolerance > 0)
    text += fmt::format(", matches good to {} images", arguments.tolerance);
  return text;
}

// Poses and names determine the number of images; a prediction beyond belongs to another set.
void require_known(const std::string& path, const std::vector<LoopPrediction>& predictions,
                   const GivenTruth& given) {
  const auto images_of = [&](const std::optional<ImageSet>& set) {
    const auto unlimited = std::numeric_limits<std::int64_t>::max();
    if (given.poses) return static_cast<std::int64_t>(given.poses->size());
    return set ? static_cast<std::int64_t>(set->size()) : unlimited;
  };
  const std::int64_t queries = images_of(given.queries), candidates = images_of(given.database);
  for (const LoopPrediction& p : predictions) {
    if (p.query.value() < queries && p.candidate.value() < candidates) continue;
    const bool query = p.query.value() >= queries;
    const std::string what =
        fmt::format("{} {}, and there are {} images of {}", query ? "query" : "candidate",
                    query ? p.query.value() : p.candidate.value(), query ? queries : candidates,
                    given.poses ? "the drive" : query ? "the queries" : "the database");
    throw p.line > 0 ? FileError(path, p.line, what) : FileError(path, what);
  }
}

std::vector<LoopJudgement> judge(const LoopsArguments& arguments, const GivenTruth& given) {
  std::vector<LoopJudgement> judgements;
  for (std::size_t i = 0; i < arguments.predictions.size(); ++i) {
    const std::string& path = arguments.predictions[i];
    LoopFileOptions reading;
    reading.format = arguments.formats[arguments.formats.size() == 1 ? 0 : i];
    reading.scores_of_top_k = arguments.scores_of_top_k;
    reading.queries = given.queries ? &*given.queries : nullptr;
    reading.candidates = given.database ? &*given.database : nullptr;
    const LoopPredictionFile file = read_loop_prediction_file(path, reading);
    require_known(path, file.predictions, given);
    LoopJudgeOptions options;
    options.tolerance = arguments.tolerance;
    options.scores = arguments.scores.value_or(file.scores.value_or(ScoreKind::kSimilarity));
    LoopJudgement& judgement = judgements.emplace_back();
    judgement.name = arguments.names.empty() ? std::filesystem::path(path).filename().string()
                                             : arguments.names[i];
    judgement.path = path;
    judgement.form = file.form;
    try {
      judgement.benchmark = judge_loops(given.truth, file.predictions, options);
    } catch (const ArgumentError& error) {
      throw FileError(path, error.what());
    }
    if (reading.format == LoopFileFormat::kRun)
      judgement.reliability = reliability_of(judgement.benchmark.candidates);
  }
  return judgements;
}

json number_or_null(const std::optional<double>& value) { return value ? json(*value) : json(); }

json json_of(const LoopJudgement& judgement) {
  const LoopBenchmark& b = judgement.benchmark;
  int hits = 0, misses = 0;
  if (!b.curve.curve.empty()) {
    hits = b.curve.curve.back().hits;
    misses = b.curve.curve.back().misses;
  }
  json report = {{"name", judgement.name},
                 {"predictions_file", judgement.path},
                 {"positives", b.positives},
                 {"answered", b.predicted_queries},
                 {"hits", hits},
                 {"misses", misses},
                 {"dropped", b.dropped},
                 {"unjudged", b.unjudged},
                 {"queries", b.queries.size()},
                 {"comparison", to_string(b.protocol)},
                 {"predictions_form", judgement.form},
                 {"scores", to_string(b.scores)},
                 {"ap", number_or_null(b.curve.average_precision)},
                 {"ap_of_answers", number_or_null(b.curve.average_precision_of_answers)},
                 {"auc_of_answers", number_or_null(b.curve.area_of_answers)},
                 {"recall_at_100p", number_or_null(b.curve.recall_at_full_precision)},
                 {"f1_max", number_or_null(b.curve.f1_max)}};
  for (std::size_t i = 0; i < b.recall_at.size(); ++i) {
    const std::string key = fmt::format("r_at_{}", LoopBenchmark::kRanks[i]);
    report[key] = number_or_null(b.recall_at[i]);
    report[key + "_of_all"] = number_or_null(b.recall_at_of_all[i]);
  }
  if (!judgement.reliability) return report;
  report["candidates"] = b.candidates.size();
  report["calibration_error"] = judgement.reliability->calibration_error;
  for (const ReliabilityBin& bin : judgement.reliability->bins)
    report["reliability"].push_back({{"candidates", bin.predictions},
                                     {"mean_probability", bin.mean_probability},
                                     {"share_right", bin.share_right}});
  return report;
}

std::string cell(const std::optional<double>& value) {
  return value ? fmt::format("{:.4f}", *value) : "none";
}

/// Remarks on omitted predictions and on the reliability of the probabilities.
std::string remarks_text(const std::vector<LoopJudgement>& judgements) {
  std::string text;
  for (const LoopJudgement& judgement : judgements) {
    const LoopBenchmark& b = judgement.benchmark;
    if (b.dropped > 0 || b.unjudged > 0)
      text += fmt::format(
          "{}: left out: {} predictions for images that the truth does not cover,  {} whose "
          "candidate is too young or out of range\n",
          judgement.name, b.unjudged, b.dropped);
  }
  for (const LoopJudgement& judgement : judgements) {
    if (!judgement.reliability) continue;
    text += fmt::format("{}: calibration error of the probabilities of {} candidates: {:.3f}\n",
                        judgement.name, judgement.benchmark.candidates.size(),
                        judgement.reliability->calibration_error);
    for (const ReliabilityBin& bin : judgement.reliability->bins)
      if (bin.predictions > 0)
        text += fmt::format("  mean probability {:.3f}: share correct {:.3f} ({} candidates)\n",
                            bin.mean_probability, bin.share_right, bin.predictions);
  }
  return text;
}

std::string to_log(const std::vector<LoopJudgement>& judgements) {
  CsvText csv;
  csv.row("system", "query", "has_match", "verdict", "candidate", "score", "rank", "stage");
  for (const LoopJudgement& judgement : judgements)
    for (const JudgedQuery& query : judgement.benchmark.queries) {
      const bool predicted =
          query.verdict == LoopVerdict::kHit || query.verdict == LoopVerdict::kMiss;
      const LoopPrediction& best = query.best;
      csv.row(judgement.name, query.query, query.has_match ? 1 : 0, to_string(query.verdict),
              predicted ? to_string(best.candidate) : "",
              predicted ? fmt::format("{:.9g}", best.score) : "", query.rank, best.stage);
    }
  return csv.text();
}

/// Precision and recall at every threshold.
std::string to_curve(const std::vector<LoopJudgement>& judgements) {
  CsvText csv;
  csv.row("system", "threshold", "hits", "misses", "precision", "recall");
  for (const LoopJudgement& judgement : judgements)
    for (const PrecisionRecallPoint& point : judgement.benchmark.curve.curve)
      csv.row(judgement.name, fmt::format("{:.9g}", point.threshold), point.hits, point.misses,
              fmt::format("{:.9g}", point.precision), fmt::format("{:.9g}", point.recall));
  return csv.text();
}

void write_outputs(const LoopsArguments& arguments, const std::vector<LoopJudgement>& judgements,
                   const std::string& protocol) {
  if (!arguments.csv.empty()) write_file(arguments.csv, to_log(judgements));
  if (!arguments.curve.empty()) write_file(arguments.curve, to_curve(judgements));
  if (arguments.plot.empty()) return;
  std::vector<NamedPrecisionRecall> curves;
  for (const LoopJudgement& judgement : judgements)
    curves.push_back({judgement.name, judgement.benchmark.curve});
  write_plot(arguments.plot, precision_recall_picture(protocol, curves));
}

void check(const LoopsArguments& arguments) {
  for (const std::string& path : {arguments.csv, arguments.plot, arguments.curve, arguments.report})
    if (!path.empty()) require_free(path, arguments.force);
  if (!arguments.report.empty()) require_page_name(arguments.report);
  require_plot_name(arguments.plot);
  const std::size_t systems = arguments.predictions.size();
  require(systems > 0, "--predictions: none are given");
  const bool sets = !arguments.queries.empty() && !arguments.database.empty();
  require(arguments.queries.empty() == arguments.database.empty(),
          "--queries and --database: both are needed, one set of images each");
  require(arguments.truth.empty() || arguments.poses.empty(),
          "--truth and --true-poses: only one of them");
  require(!arguments.truth.empty() || !arguments.poses.empty() || sets,
          "one of --truth, --true-poses, and --queries with --database is needed");
  require(!sets || arguments.poses.empty(),
          "--true-poses is of one drive: give the poses of two as --queries and --database");
  require(!(sets && arguments.within), "--within is of one drive, --queries and --database of two");
  require(!sets || arguments.min_age.value_or(0) == 0,
          "--min-age: the images of a database have none; it is of candidates within one drive");
  require(arguments.scores_of_top_k.empty() || systems == 1,
          "--top-k-scores: of one file of --predictions");
  require(arguments.formats.size() == 1 || arguments.formats.size() == systems,
          "--format: one for all, or one for each of --predictions");
  require(arguments.names.empty() || arguments.names.size() == systems,
          "--systems: one for each of --predictions");
  arguments.revisit.check();
}

}  // namespace

LoopsResult loops(const LoopsArguments& arguments) {
  check(arguments);
  GivenTruth given = truth_of(arguments);
  LoopsResult result;
  result.systems = judge(arguments, given);
  result.protocol = protocol_text(arguments, given, result.systems.front().benchmark.protocol);
  result.truth = std::move(given.truth);
  result.poses = std::move(given.poses);
  for (const LoopJudgement& judgement : result.systems) {
    for (const Doubt& doubt : judgement.benchmark.doubts) warn(judgement.name + ": " + doubt.text);
    if (!judgement.benchmark.outcome)
      throw NoResult(judgement.name + ": " + judgement.benchmark.outcome.reason);
  }
  write_outputs(arguments, result.systems, result.protocol);
  return result;
}

std::string to_json(const LoopsResult& result) {
  json report = json_of(result.systems.front());
  if (result.systems.size() > 1) {
    report = json::object();
    for (const LoopJudgement& judgement : result.systems)
      report["systems"].push_back(json_of(judgement));
  }
  report["protocol"] = result.protocol;
  return json_text(report, 1);
}

std::string to_text(const LoopsResult& result) {
  std::size_t width = 6;
  for (const LoopJudgement& judgement : result.systems)
    width = std::max(width, judgement.name.size());
  std::string text = fmt::format("{}\n{:<{}} {:>9} {:>8}", result.protocol, "system", width,
                                 "positives", "answered");
  for (const int rank : LoopBenchmark::kRanks) text += fmt::format(" {:>7}", fmt::format("R@{}", rank));
  text += fmt::format(" {:>7} {:>14} {:>7}\n", "AP", "recall at 100p", "F1 max");
  for (const LoopJudgement& judgement : result.systems) {
    const LoopBenchmark& b = judgement.benchmark;
    text += fmt::format("{:<{}} {:>9} {:>8}", judgement.name, width, b.positives,
                        b.predicted_queries);
    for (const auto& recall : b.recall_at) text += fmt::format(" {:>7}", cell(recall));
    text += fmt::format(" {:>7} {:>14} {:>7}\n", cell(b.curve.average_precision),
                        cell(b.curve.recall_at_full_precision), cell(b.curve.f1_max));
  }
  return text + remarks_text(result.systems);
}

}  // namespace placegraph::apps
