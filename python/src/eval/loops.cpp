#include <placegraph/eval/loops/loop_benchmark.h>
#include <placegraph/eval/loops/loop_protocol.h>
#include <placegraph/eval/loops/loop_truth_from_poses.h>
#include <placegraph/eval/loops/reliability.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/loops/image_set.h>
#include <placegraph/io/loops/loop_file.h>

#include <fmt/format.h>
#include <nanobind/stl/map.h>
#include <cmath>
#include <limits>
#include <map>

#include "python/src/eval/loop_columns.h"
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
                         bool unlisted_have_none, std::int64_t min_age,
                         std::optional<bool> within) {
  LoopTruth truth;
  truth.unlisted_have_none = unlisted_have_none;
  for (const auto& [query, list] : matches) {
    LoopQuery& entry = truth.queries[image_id(query, "matches")];
    for (const std::int64_t match : list) entry.matches.push_back(image_id(match, "matches"));
    std::sort(entry.matches.begin(), entry.matches.end());
    const auto last = std::unique(entry.matches.begin(), entry.matches.end());
    entry.matches.erase(last, entry.matches.end());
  }
  choose_protocol(truth, {within, min_age}, 0);
  return truth;
}

LoopTruth truth_of_matrix(const ArrayArgument<bool>& argument, std::optional<std::int64_t> min_age,
                          std::optional<bool> within) {
  const auto matrix = argument.get("matrix", {kAny, kAny});
  const std::size_t columns = matrix.shape(1);
  require(columns > 0, "matrix: it has no columns");
  const std::vector<bool> matches(matrix.data(), matrix.data() + matrix.shape(0) * columns);
  LoopTruth truth = loop_truth_of_matrix(matches, columns);
  choose_protocol(truth, {within, min_age}, 0);
  return truth;
}

LoopTruth truth_of_file(const std::filesystem::path& path, std::optional<std::int64_t> min_age,
                        std::optional<bool> within) {
  LoopTruthFile file = read_loop_truth(path.string());
  choose_protocol(file.truth, {within, min_age}, RevisitOptions().min_age);
  return std::move(file.truth);
}

LoopTruth truth_of_poses(const Trajectory& truth, const OptionsArgument<RevisitOptions>& options) {
  const RevisitOptions chosen = options.get();
  chosen.check();
  for (const Doubt& doubt : heading_doubts(truth, chosen.same)) warn(doubt.text);
  const WithoutGil released;
  return loop_truth_from_poses(truth, chosen);
}

LoopTruth truth_of_sets(const ImageSet& queries, const ImageSet& database,
                        const OptionsArgument<RevisitOptions>& options) {
  const RevisitOptions chosen = options.get();
  ImageSet asking = queries, answering = database;
  put_in_one_frame(answering, asking);
  Trajectory both = answering.poses;
  both.has_orientation &= asking.poses.has_orientation;
  for (const Doubt& doubt : heading_doubts(both, chosen.same)) warn(doubt.text);
  const WithoutGil released;
  return loop_truth_between(asking.poses, answering.poses, chosen.same);
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
  static const std::vector<std::string> names = {"scores", "ibow", "run", "topk", "matrix"};
  return choice_of<LoopFileFormat>(name, names, "format");
}

ScoreKind kind_of(const std::string& name) {
  static const std::vector<std::string> names = {"similarity", "distance"};
  return choice_of<ScoreKind>(name, names, "scores");
}

}  // namespace

Table columns_of(const std::vector<LoopPrediction>& predictions) {
  std::vector<std::int64_t> query, candidate;
  std::vector<double> score;
  for (const LoopPrediction& each : predictions) {
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

namespace {

/// Columns of the predictions of a file, and what its scores are.
std::pair<Table, std::optional<std::string>> read_predictions(const std::string& path,
                                                              const std::string& format,
                                                              const std::string& top_k_scores,
                                                              const ImageSet* queries,
                                                              const ImageSet* database) {
  const LoopPredictionFile file = read_loop_prediction_file(
      path, {format_of(format), top_k_scores, queries, database});
  std::optional<std::string> kind;
  if (file.scores) kind = to_string(*file.scores);
  return {columns_of(file.predictions), kind};
}

Table search_columns(const ArrayArgument<std::int64_t>& candidate,
                     const ArrayArgument<double>& score) {
  const auto candidates = candidate.get("candidate", {kAny, kAny});
  const auto scores = score.get("score", {kAny, kAny});
  require_same_rows(scores.shape(0), candidates.shape(0), "score", "candidate");
  const std::size_t columns = candidates.shape(1), count = candidates.shape(0) * columns;
  require(scores.shape(1) == columns, "score: it has another number of columns than candidate");
  return columns_of(predictions_of_search({candidates.data(), candidates.data() + count},
                                          {scores.data(), scores.data() + count}, columns));
}

Table matrix_columns(const ArrayArgument<double>& score) {
  const auto scores = score.get("score", {kAny, kAny});
  return columns_of(predictions_of_matrix(
      {scores.data(), scores.data() + scores.shape(0) * scores.shape(1)}, scores.shape(1)));
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
                     const ArrayArgument<double>& score, int tolerance,
                     const std::string& scores) {
  require(tolerance >= 0, "tolerance: it must not be negative");
  const std::vector<LoopPrediction> predictions = predictions_of(query, candidate, score);
  const LoopJudgeOptions options{tolerance, kind_of(scores)};
  const WithoutGil released;
  return judge_loops(truth, predictions, options);
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
             bool unlisted_have_none, std::int64_t min_age, std::optional<bool> within) {
            new (self) LoopTruth(truth_of_lists(matches, unlisted_have_none, min_age, within));
          },
          "matches"_a, "unlisted_have_none"_a = true, "min_age"_a = 0, "within"_a = nb::none(),
          "The true matches of each query image.\n\n`unlisted_have_none`: images that are not "
          "listed have no true match; otherwise predictions there are not judged. Candidates less "
          "than `min_age` images before the query are neither hits nor misses; with 0, candidates "
          "are images of a database, unless `within` says that they are of the same drive.")
      .def_static("from_matrix", &truth_of_matrix, "matrix"_a, "min_age"_a = nb::none(),
                  "within"_a = nb::none(),
                  "The truth of a matrix of bool (N x M) whose row is the query and whose column "
                  "the candidate.\n\nRows and columns are one drive if `within` is true or "
                  "`min_age` is above 0, and queries and a database if `within` is false or "
                  "`min_age` is 0. Without both, a matrix that is not square is of two sets, and a "
                  "square one is decided with the predictions, or refused.")
      .def_static("read", &truth_of_file, "path"_a, "min_age"_a = nb::none(),
                  "within"_a = nb::none(),
                  "Reads true loop closures in any of the three formats of `placegraph loops "
                  "--truth`.\n\n`min_age`: by default 300 images, and 0 for a file that lists the "
                  "candidates of each query. `within`: whether candidates are of the queries' own "
                  "drive, as of `from_matrix`.")
      .def_static("from_poses", &truth_of_poses, "truth"_a, "options"_a = nb::none(),
                  doc("loop_truth_from_poses"))
      .def_static("between", &truth_of_sets, "queries"_a, "database"_a, "options"_a = nb::none(),
                  doc("loop_truth_between"))
      .def_prop_ro("matches", &lists_of, "True matches by the query image.")
      .def_ro("min_age", &LoopTruth::min_age, doc("LoopTruth::min_age"))
      .def_prop_ro(
          "protocol", [](const LoopTruth& truth) { return to_string(truth.protocol); },
          doc("LoopTruth::protocol"))
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

void bind_image_set(nb::module_& m) {
  nb::class_<ImageSet> bound(m, "ImageSet", doc("ImageSet"));
  bound
      .def(
          "__init__",
          [](ImageSet* self, const std::vector<std::string>& names,
             const std::optional<Trajectory>& poses) {
            require(!poses || names.empty() || poses->size() == names.size(),
                    "names: there is not one for each pose");
            new (self) ImageSet{names, poses.value_or(Trajectory{}), {}, "", "poses"};
          },
          "names"_a = std::vector<std::string>{}, "poses"_a = nb::none(),
          "The images of a set: their names, their poses, or both.")
      .def_static(
          "read", [](const std::filesystem::path& path) { return read_image_set(path.string()); },
          "path"_a, doc("read_image_set"))
      .def_ro("names", &ImageSet::names, doc("ImageSet::names"))
      .def_prop_ro(
          "poses", [](const ImageSet& set) { return set.poses; }, doc("ImageSet::poses"))
      .def_ro("form", &ImageSet::form, doc("ImageSet::form"))
      .def("__len__", &ImageSet::size)
      .def("__repr__", [](const ImageSet& set) {
        return fmt::format("<placegraph.loops.ImageSet: {} images, {}>", set.size(), set.form);
      });
}

void bind_loops(nb::module_& m) {
  bind_option_set<RevisitOptions>(m, "RevisitOptionSet", doc("RevisitOptions"));
  bind_image_set(m);
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
          "Shares of the positives with a true candidate among the 1, 5, 10 and 20 best; each is None "
          "without positives.")
      .def_prop_ro(
          "recall_at_of_all",
          [](const LoopBenchmark& b) {
            return TupleOf<std::optional<double>>{
                {b.recall_at_of_all.begin(), b.recall_at_of_all.end()}};
          },
          doc("LoopBenchmark::recall_at_of_all"))
      .def_prop_ro(
          "protocol", [](const LoopBenchmark& b) { return to_string(b.protocol); },
          doc("LoopBenchmark::protocol"))
      .def_prop_ro(
          "scores", [](const LoopBenchmark& b) { return to_string(b.scores); },
          doc("LoopBenchmark::scores"))
      .def_prop_ro(
          "average_precision_of_answers",
          [](const LoopBenchmark& b) { return b.curve.average_precision_of_answers; },
          doc("PrecisionRecall::average_precision_of_answers"))
      .def_prop_ro(
          "area_of_answers", [](const LoopBenchmark& b) { return b.curve.area_of_answers; },
          doc("PrecisionRecall::area_of_answers"))
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
        "top_k_scores"_a = "", "queries"_a = nb::none(), "database"_a = nb::none(),
        "Reads the loop closures that a place recognizer proposes, as columns query, candidate and "
        "score, and what the file says that its scores are.\n\n`format`: 'scores' (lines `query "
        "candidate score`), 'ibow', 'run' (loops.csv of a run), 'topk' or 'matrix'. `queries` and "
        "`database`: images whose names stand in the file.");
  m.def("search_columns", &search_columns, "candidate"_a, "score"_a,
        "Columns query, candidate and score of the results of a search (Q x K), -1: none.");
  m.def("matrix_columns", &matrix_columns, "score"_a,
        "Columns query, candidate and score of a matrix of scores (Q x M), NaN: none.");
  m.def("judge_loops", &judged, "truth"_a, "query"_a, "candidate"_a, "score"_a, "tolerance"_a = 0,
        "scores"_a = "similarity", doc("judge_loops"));
}

}  // namespace placegraph::python
