#include "apps/eval/loops.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/text/csv_text.h>
#include <placegraph/graph/text/json_text.h>
#include <placegraph/io/trajectories/trajectory_file.h>
#include <placegraph/pipeline/report/loops_page.h>
#include <placegraph/pipeline/report/run_page.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/support/output.h"
#include "apps/support/plot_file.h"

namespace placegraph::apps {
namespace {

using nlohmann::json;

struct Protocol {
  LoopTruth truth;
  std::optional<Trajectory> poses;
  std::string text;
};

Protocol protocol_of(const LoopsArguments& arguments) {
  Protocol protocol;
  if (!arguments.poses.empty()) {
    RevisitOptions revisit = arguments.revisit;
    revisit.min_age = arguments.min_age.value_or(revisit.min_age);
    protocol.poses = warned(read_trajectory(arguments.poses));
    protocol.truth = loop_truth_from_poses(*protocol.poses, revisit);
    protocol.text = fmt::format("poses within {:g} m and {:g} deg", revisit.same.radius_m,
                                revisit.same.heading_deg);
  } else {
    LoopTruthFile file = read_loop_truth(arguments.truth);
    const bool ranges = file.format == LoopTruthFormat::kRanges;
    protocol.text = ranges ? "matches and candidates listed per query" : "matches listed per query";
    if (file.format == LoopTruthFormat::kMatrix) protocol.text = "matrix of matches";
    protocol.truth = std::move(file.truth);
    protocol.truth.min_age = arguments.min_age.value_or(ranges ? 0 : arguments.revisit.min_age);
  }
  if (protocol.truth.min_age > 0)
    protocol.text += fmt::format(", candidates at least {} images older", protocol.truth.min_age);
  if (arguments.tolerance > 0)
    protocol.text += fmt::format(", matches good to {} images", arguments.tolerance);
  return protocol;
}

// The poses determine the number of images; a prediction beyond them belongs to another set.
void require_known(const std::string& path, const std::vector<LoopPrediction>& predictions,
                   std::int64_t images) {
  for (const LoopPrediction& p : predictions)
    if (p.query.value() >= images || p.candidate.value() >= images)
      throw FileError(path, p.line,
                      fmt::format("image {}, and the poses are of {}",
                                  std::max(p.query, p.candidate).value(), images));
}

std::vector<LoopJudgement> judge(const LoopsArguments& arguments, const Protocol& protocol) {
  std::vector<LoopJudgement> judgements;
  for (std::size_t i = 0; i < arguments.predictions.size(); ++i) {
    const std::string& path = arguments.predictions[i];
    const LoopFileFormat format = arguments.formats[arguments.formats.size() == 1 ? 0 : i];
    const auto predictions = read_loop_predictions(path, format);
    if (!arguments.poses.empty() && !protocol.truth.queries.empty())
      require_known(path, predictions, protocol.truth.queries.rbegin()->first.value() + 1);
    const std::string name = arguments.names.empty()
                                 ? std::filesystem::path(path).filename().string()
                                 : arguments.names[i];
    LoopJudgement& judgement = judgements.emplace_back();
    judgement.name = name;
    judgement.path = path;
    judgement.benchmark = judge_loops(protocol.truth, predictions, arguments.tolerance);
    if (format == LoopFileFormat::kRun)
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
                 {"r_at_1", number_or_null(b.recall_at[0])},
                 {"r_at_5", number_or_null(b.recall_at[1])},
                 {"r_at_10", number_or_null(b.recall_at[2])},
                 {"ap", number_or_null(b.curve.average_precision)},
                 {"recall_at_100p", number_or_null(b.curve.recall_at_full_precision)},
                 {"f1_max", number_or_null(b.curve.f1_max)}};
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

void write_outputs(const LoopsArguments& arguments, const std::vector<LoopJudgement>& judgements,
                   const std::string& protocol) {
  if (!arguments.csv.empty()) write_file(arguments.csv, to_log(judgements));
  if (arguments.plot.empty()) return;
  std::vector<NamedPrecisionRecall> curves;
  for (const LoopJudgement& judgement : judgements)
    curves.push_back({judgement.name, judgement.benchmark.curve});
  write_plot(arguments.plot, precision_recall_picture(protocol, curves));
}

void check(const LoopsArguments& arguments) {
  for (const std::string& path : {arguments.csv, arguments.plot, arguments.report})
    if (!path.empty()) require_free(path, arguments.force);
  if (!arguments.report.empty()) require_page_name(arguments.report);
  require_plot_name(arguments.plot);
  const std::size_t systems = arguments.predictions.size();
  require(systems > 0, "--predictions: none are given");
  require(arguments.truth.empty() != arguments.poses.empty(),
          "one of --truth and --true-poses is needed");
  require(arguments.formats.size() == 1 || arguments.formats.size() == systems,
          "--format: one for all, or one for each of --predictions");
  require(arguments.names.empty() || arguments.names.size() == systems,
          "--systems: one for each of --predictions");
  arguments.revisit.check();
}

}  // namespace

LoopsResult loops(const LoopsArguments& arguments) {
  check(arguments);
  Protocol protocol = protocol_of(arguments);
  LoopsResult result{protocol.text, judge(arguments, protocol), {}, {}};
  result.truth = std::move(protocol.truth);
  result.poses = std::move(protocol.poses);
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
  std::string text = fmt::format("{}\n{:<{}} {:>9} {:>8} {:>7} {:>7} {:>7} {:>7} {:>14} {:>7}\n",
                                 result.protocol, "system", width, "positives", "answered", "R@1",
                                 "R@5", "R@10", "AP", "recall at 100p", "F1 max");
  for (const LoopJudgement& judgement : result.systems) {
    const LoopBenchmark& b = judgement.benchmark;
    text += fmt::format("{:<{}} {:>9} {:>8} {:>7} {:>7} {:>7} {:>7} {:>14} {:>7}\n", judgement.name,
                        width, b.positives, b.predicted_queries, cell(b.recall_at[0]),
                        cell(b.recall_at[1]), cell(b.recall_at[2]), cell(b.curve.average_precision),
                        cell(b.curve.recall_at_full_precision), cell(b.curve.f1_max));
  }
  return text + remarks_text(result.systems);
}

}  // namespace placegraph::apps
