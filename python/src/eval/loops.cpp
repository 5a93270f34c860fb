#include <placegraph/eval/loops/loop_benchmark.h>
#include <placegraph/eval/loops/loop_truth_from_poses.h>
#include <placegraph/eval/loops/reliability.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/measurements/loop_file.h>

#include <fmt/format.h>
#include <nanobind/stl/map.h>
#include <cmath>
#include <limits>
#include <map>

#include "python/src/frontend/functions.h"
#include "python/src/values/value_class.h"
#include "python/src/warnings.h"

namespace placegraph::python {
namespace {

using namespace nb::literals;

FrameId image_id(std::int64_t value, const char* argument) {
  require(value >= 0 && value < 1'000'000'000,
          std::string(argument) + ": image " + std::to_string(value) + " is not in [0, 1e9)");
  return FrameId(value);
}

LoopTruth truth_of_lists(const std::map<std::int64_t, std::vector<std::int64_t>>& matches,
                         bool unlisted_have_none, std::int64_t min_age) {
  require(min_age >= 0, "min_age: it must not be negative");
  LoopTruth truth;
  truth.unlisted_have_none = unlisted_have_none;
  truth.min_age = min_age;
  for (const auto& [query, list] : matches) {
    LoopQuery& entry = truth.queries[image_id(query, "matches")];
    for (const std::int64_t match : list) entry.matches.push_back(image_id(match, "matches"));
    std::sort(entry.matches.begin(), entry.matches.end());
    const auto last = std::unique(entry.matches.begin(), entry.matches.end());
    entry.matches.erase(last, entry.matches.end());
  }
  return truth;
}

LoopTruth truth_of_matrix(const ArrayArgument<bool>& argument, std::int64_t min_age) {
  const auto matrix = argument.get("matrix", {kAny, kAny});
  require(matrix.shape(0) == matrix.shape(1), "matrix: it must be square");
  std::map<std::int64_t, std::vector<std::int64_t>> matches;
  const std::size_t n = matrix.shape(0);
  for (std::size_t query = 0; query < n; ++query) {
    auto& list = matches[static_cast<std::int64_t>(query)];
    for (std::size_t match = 0; match < query; ++match)
      if (matrix.data()[n * query + match]) list.push_back(static_cast<std::int64_t>(match));
  }
  return truth_of_lists(matches, true, min_age);
}

LoopTruth truth_of_file(const std::filesystem::path& path, std::optional<std::int64_t> min_age) {
  require(min_age.value_or(0) >= 0, "min_age: it must not be negative");
  LoopTruthFile file = read_loop_truth(path.string());
  const bool ranges = file.format == LoopTruthFormat::kRanges;
  file.truth.min_age = min_age.value_or(ranges ? 0 : RevisitOptions().min_age);
  return std::move(file.truth);
}

std::map<std::int64_t, std::vector<std::int64_t>> lists_of(const LoopTruth& truth) {
  std::map<std::int64_t, std::vector<std::int64_t>> lists;
  for (const auto& [query, entry] : truth.queries) {
    auto& list = lists[query.value()];
    for (const FrameId match : entry.matches) list.push_back(match.value());
  }
  return lists;
}

LoopFileFormat format_of(const std::string& name) {
  static const std::vector<std::string> names = {"scores", "ibow", "run"};
  return choice_of<LoopFileFormat>(name, names, "format");
}

/// Columns of predictions.
Table read_predictions(const std::string& path, const std::string& format) {
  std::vector<std::int64_t> query, candidate;
  std::vector<double> score;
  for (const LoopPrediction& each : read_loop_predictions(path, format_of(format))) {
    query.push_back(each.query.value());
    candidate.push_back(each.candidate.value());
    score.push_back(each.score);
  }
  const std::size_t n = query.size();
  Table columns;
  columns["query"] = owned_array(std::move(query), {n});
  columns["candidate"] = owned_array(std::move(candidate), {n});
  columns["score"] = owned_array(std::move(score), {n});
  return columns;
}

std::vector<LoopPrediction> predictions_of(const ArrayArgument<std::int64_t>& query,
                                           const ArrayArgument<std::int64_t>& candidate,
                                           const ArrayArgument<double>& score) {
  const auto queries = query.get("query", {kAny}), candidates = candidate.get("candidate", {kAny});
  const auto scores = score.get("score", {kAny});
  require_same_rows(candidates.shape(0), queries.shape(0), "candidate", "query");
  require_same_rows(scores.shape(0), queries.shape(0), "score", "query");
  std::vector<LoopPrediction> predictions;
  for (std::size_t i = 0; i < queries.shape(0); ++i)
    predictions.push_back({image_id(queries.data()[i], "query"),
                           image_id(candidates.data()[i], "candidate"),
                           scores.data()[i],
                           {},
                           0});
  return predictions;
}

LoopBenchmark judged(const LoopTruth& truth, const ArrayArgument<std::int64_t>& query,
                     const ArrayArgument<std::int64_t>& candidate,
                     const ArrayArgument<double>& score, int tolerance) {
  require(tolerance >= 0, "tolerance: it must not be negative");
  const std::vector<LoopPrediction> predictions = predictions_of(query, candidate, score);
  const WithoutGil released;
  return judge_loops(truth, predictions, tolerance);
}

/// Columns of a precision-recall curve.
Table curve_table(const LoopBenchmark& benchmark) {
  std::vector<double> threshold, precision, recall;
  std::vector<std::int64_t> hits, misses;
  for (const PrecisionRecallPoint& point : benchmark.curve.curve) {
    threshold.push_back(point.threshold);
    hits.push_back(point.hits);
    misses.push_back(point.misses);
    precision.push_back(point.precision);
    recall.push_back(point.recall);
  }
  const std::size_t n = threshold.size();
  Table table;
  table["threshold"] = owned_array(std::move(threshold), {n});
  table["hits"] = owned_array(std::move(hits), {n});
  table["misses"] = owned_array(std::move(misses), {n});
  table["precision"] = owned_array(std::move(precision), {n});
  table["recall"] = owned_array(std::move(recall), {n});
  return table;
}

/// Columns of the queries; without a candidate it is -1 and the score NaN.
Table query_table(const LoopBenchmark& benchmark) {
  std::vector<std::int64_t> query, candidate, rank;
  std::vector<double> score;
  std::vector<std::uint8_t> has_match;
  nb::list verdict;
  for (const JudgedQuery& each : benchmark.queries) {
    const bool predicted = each.verdict == LoopVerdict::kHit || each.verdict == LoopVerdict::kMiss;
    query.push_back(each.query.value());
    has_match.push_back(each.has_match);
    verdict.append(to_string(each.verdict));
    candidate.push_back(predicted ? each.best.candidate.value() : -1);
    score.push_back(predicted ? each.best.score : std::numeric_limits<double>::quiet_NaN());
    rank.push_back(each.rank);
  }
  const std::size_t n = query.size();
  Table table;
  table["query"] = owned_array(std::move(query), {n});
  table["has_match"] = nb::cast(owned_array(std::move(has_match), {n})).attr("view")("bool");
  table["verdict"] = verdict;
  table["candidate"] = owned_array(std::move(candidate), {n});
  table["score"] = owned_array(std::move(score), {n});
  table["rank"] = owned_array(std::move(rank), {n});
  return table;
}

/// Reliability of scores that are probabilities.
Table reliability_table(const LoopBenchmark& benchmark) {
  const Reliability reliability = reliability_of(benchmark.candidates);
  std::vector<std::int64_t> candidates;
  std::vector<double> mean, share;
  for (const ReliabilityBin& bin : reliability.bins) {
    candidates.push_back(bin.predictions);
    mean.push_back(bin.mean_probability);
    share.push_back(bin.share_right);
  }
  const std::size_t n = candidates.size();
  Table table;
  table["candidates"] = owned_array(std::move(candidates), {n});
  table["mean_probability"] = owned_array(std::move(mean), {n});
  table["share_right"] = owned_array(std::move(share), {n});
  table["calibration_error"] = reliability.calibration_error;
  return table;
}

void bind_truth(nb::module_& m) {
  nb::class_<LoopTruth> bound(m, "LoopTruth", doc("LoopTruth"));
  bind_value(bound, Hash::kByValue);
  bound
      .def(
          "__init__",
          [](LoopTruth* self, const std::map<std::int64_t, std::vector<std::int64_t>>& matches,
             bool unlisted_have_none, std::int64_t min_age) {
            new (self) LoopTruth(truth_of_lists(matches, unlisted_have_none, min_age));
          },
          "matches"_a, "unlisted_have_none"_a = true, "min_age"_a = 0,
          "The true matches of each query image.\n\n`unlisted_have_none`: images that are not "
          "listed have no true match; otherwise predictions there are not judged. Candidates less "
          "than `min_age` images before the query are neither hits nor misses.")
      .def_static("from_matrix", &truth_of_matrix, "matrix"_a, "min_age"_a = 0,
                  "The truth of a square matrix of bool (N x N) whose row is the query and whose "
                  "column the older image.")
      .def_static("read", &truth_of_file, "path"_a, "min_age"_a = nb::none(),
                  "Reads true loop closures in any of the three formats of `placegraph loops "
                  "--truth`.\n\n`min_age`: by default 300 images, and 0 for a file that lists the "
                  "candidates of each query.")
      .def_static(
          "from_poses",
          [](const Trajectory& truth, const OptionsArgument<RevisitOptions>& options) {
            const RevisitOptions chosen = options.get();
            const WithoutGil released;
            return loop_truth_from_poses(truth, chosen);
          },
          "truth"_a, "options"_a = nb::none(), doc("loop_truth_from_poses"))
      .def_prop_ro("matches", &lists_of, "True matches by the query image.")
      .def_ro("min_age", &LoopTruth::min_age, doc("LoopTruth::min_age"))
      .def_ro("unlisted_have_none", &LoopTruth::unlisted_have_none,
              doc("LoopTruth::unlisted_have_none"))
      .def("__len__", [](const LoopTruth& truth) { return truth.queries.size(); })
      .def("__repr__", [](const LoopTruth& truth) {
        std::size_t matches = 0;
        for (const auto& [query, entry] : truth.queries) matches += entry.matches.size();
        return fmt::format("<placegraph.loops.LoopTruth: {} queries, {} matches>",
                           truth.queries.size(), matches);
      });
}

}  // namespace

void bind_loops(nb::module_& m) {
  bind_option_set<RevisitOptions>(m, "RevisitOptionSet", doc("RevisitOptions"));
  bind_truth(m);
  nb::class_<LoopBenchmark> benchmark(m, "LoopBenchmark", doc("LoopBenchmark"));
  bind_outcome(benchmark);
  bind_value(benchmark, Hash::kByValue);
  benchmark.def_ro("positives", &LoopBenchmark::positives, doc("LoopBenchmark::positives"))
      .def_ro("predicted_queries", &LoopBenchmark::predicted_queries,
              doc("LoopBenchmark::predicted_queries"))
      .def_ro("dropped", &LoopBenchmark::dropped, doc("LoopBenchmark::dropped"))
      .def_ro("unjudged", &LoopBenchmark::unjudged, doc("LoopBenchmark::unjudged"))
      .def_prop_ro(
          "doubts", [](const LoopBenchmark& b) { return TupleOf<std::string>{texts_of(b.doubts)}; },
          doc("LoopBenchmark::doubts"))
      .def_prop_ro(
          "recall_at",
          [](const LoopBenchmark& b) {
            return TupleOf<std::optional<double>>{{b.recall_at.begin(), b.recall_at.end()}};
          },
          "Shares of the positives with a true candidate among the 1, 5 and 10 best; each is None "
          "without positives.")
      .def_prop_ro(
          "average_precision", [](const LoopBenchmark& b) { return b.curve.average_precision; },
          doc("PrecisionRecall::average_precision"))
      .def_prop_ro(
          "recall_at_full_precision",
          [](const LoopBenchmark& b) { return b.curve.recall_at_full_precision; },
          doc("PrecisionRecall::recall_at_full_precision"))
      .def_prop_ro(
          "f1_max", [](const LoopBenchmark& b) { return b.curve.f1_max; },
          doc("PrecisionRecall::f1_max"))
      .def("curve_table", &curve_table, "Columns of the precision-recall curve.")
      .def("query_table", &query_table, "Columns of the queries.")
      .def("reliability_table", &reliability_table,
           "Agreement of scores that are probabilities with the share of right candidates, by "
           "tenths of the probability.");
  m.def("read_loop_predictions", &read_predictions, "path"_a, "format"_a = "scores",
        "Reads the loop closures that a place recognizer proposes, as columns query, candidate and "
        "score.\n\n`format`: 'scores' (lines `query candidate score`), 'ibow' or 'run' (loops.csv "
        "of a run).");
  m.def("judge_loops", &judged, "truth"_a, "query"_a, "candidate"_a, "score"_a, "tolerance"_a = 0,
        doc("judge_loops"));
}

}  // namespace placegraph::python
