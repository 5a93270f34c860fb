#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/atomic_file.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/loops/delimited_table.h>
#include <placegraph/io/loops/image_set.h>
#include <placegraph/io/loops/loop_file.h>
#include <placegraph/io/loops/name_index.h>
#include <placegraph/io/loops/number_matrix.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace placegraph {
namespace {


FrameId image_of(const TextFile& file, std::string_view field, const char* what) {
  const auto image = parse_whole(field);
  if (!image)
    file.fail(fmt::format("{}: {} is not {}", what, in_quotes(field),
                          parse_double(field) ? "a whole number" : "a number"));
  if (*image < 0 || *image >= kMaxImages)
    file.fail(std::string(what) + ": " + in_quotes(field) + " is not an image");
  return FrameId(*image);
}

/// The usual names of a column, the first one ours.
struct ColumnNames {
  std::array<std::string_view, 9> names;
  std::optional<std::size_t> in(const std::vector<std::string>& header) const {
    for (const std::string_view name : names)
      for (std::size_t i = 0; i < header.size() && !name.empty(); ++i)
        if (header[i] == name) return i;
    return std::nullopt;
  }
};
constexpr ColumnNames kQueryNames{
    {"query", "query_id", "query_index", "query_idx", "query_frame", "query_image", "q", "i"}};
constexpr ColumnNames kCandidateNames{{"candidate", "match", "database", "reference", "ref", "db",
                                       "candidate_id", "match_id", "j"}};
constexpr ColumnNames kScoreNames{
    {"score", "similarity", "sim", "probability", "confidence", "inliers", "cosine", "scores"}};
constexpr ColumnNames kDistanceNames{{"distance", "dist", "l2", "distances"}};
constexpr ColumnNames kStageNames{{"stage"}};

bool names_a_column(const std::string& field) {
  for (const ColumnNames* each : {&kQueryNames, &kCandidateNames, &kScoreNames, &kDistanceNames})
    if (each->in({field})) return true;
  return false;
}

/// The places of the columns in a row.
struct ScoreColumns {
  std::size_t query = 0, candidate = 1;
  std::optional<std::size_t> score = 2, stage;
  std::optional<ScoreKind> kind;
};

ScoreColumns columns_of(const DelimitedTable& table) {
  const std::vector<std::string>& header = table.header();
  ScoreColumns columns;
  if (header.empty()) return columns;
  const auto query = kQueryNames.in(header), candidate = kCandidateNames.in(header);
  if (!query || !candidate)
    throw FileError(table.file().path(),
                    fmt::format("its header names no column {}, only {}",
                                query ? "candidate" : "query", fmt::join(header, ", ")));
  columns.query = *query;
  columns.candidate = *candidate;
  columns.score = kScoreNames.in(header);
  if (columns.score) columns.kind = ScoreKind::kSimilarity;
  if (!columns.score && (columns.score = kDistanceNames.in(header)))
    columns.kind = ScoreKind::kDistance;
  columns.stage = kStageNames.in(header);
  return columns;
}

/// Reads images by number, or by name where the images of their set are known.
class ImageColumn {
 public:
  ImageColumn(const ImageSet* images, const char* what) : what_(what) {
    if (images && !images->names.empty()) names_.emplace(images->names);
  }
  FrameId read(const TextFile& file, std::string_view field) const {
    if (names_)
      if (const auto image = names_->find(field)) return *image;
    if (names_ && !parse_whole(field))
      file.fail(fmt::format("{}: {} is none of its images", what_, in_quotes(field)));
    return image_of(file, field, what_);
  }

 private:
  std::optional<NameIndex> names_;
  const char* what_;
};

/// Refuses a pair that stands twice.
class Distinct {
 public:
  bool add(const LoopPrediction& p) { return seen_.emplace(p.query, p.candidate).second; }

 private:
  std::set<std::pair<FrameId, FrameId>> seen_;
};

std::string named_twice(const LoopPrediction& p) {
  return "query " + to_string(p.query) + " has candidate " + to_string(p.candidate) + " already";
}

LoopPredictionFile read_table(const std::string& path, const LoopFileOptions& options) {
  DelimitedTable table(path, names_a_column);
  ScoreColumns columns = columns_of(table);
  const ImageColumn queries(options.queries, "query"), candidates(options.candidates, "candidate");
  const TextFile& file = table.file();
  LoopPredictionFile result;
  result.scores = columns.kind;
  Distinct distinct;
  std::map<FrameId, int> ranks;
  std::vector<std::string_view> fields;
  while (table.next(fields)) {
    const bool ranked = table.header().empty() && fields.size() == 2 && options.queries;
    if (table.header().empty() && !ranked && (fields.size() < 3 || fields.size() > 4))
      file.fail(fmt::format("{} columns, expected: query candidate score [stage]", fields.size()));
    if (ranked && result.predictions.empty()) columns.score.reset();
    if (table.header().empty() && ranked == columns.score.has_value())
      file.fail("lines with and without a score");
    LoopPrediction prediction;
    prediction.query = queries.read(file, fields[columns.query]);
    prediction.candidate = candidates.read(file, fields[columns.candidate]);
    prediction.score = columns.score ? file.number(fields[*columns.score], "score")
                                     : -static_cast<double>(++ranks[prediction.query]);
    if (columns.stage) prediction.stage = fields[*columns.stage];
    if (table.header().empty() && fields.size() == 4) prediction.stage = fields[3];
    prediction.line = file.line();
    if (!distinct.add(prediction)) file.fail(named_twice(prediction));
    result.predictions.push_back(std::move(prediction));
  }
  result.form = columns.score ? "lines of query, candidate and score"
                              : "lines of query and candidate, the best first";
  return result;
}

std::vector<LoopPrediction> read_ibow(TextFile& file) {
  constexpr std::size_t kColumns = 7;
  std::vector<LoopPrediction> predictions;
  std::string_view line;
  std::vector<std::string_view> fields;
  for (FrameId query; file.next(line); ++query) {
    split_blank(line, fields);
    if (fields.size() != kColumns)
      file.fail(std::to_string(fields.size()) +
                " columns, expected 7: first last matched consistent inliers words seconds");
    const FrameId first = image_of(file, fields[0], "first");
    const FrameId last = image_of(file, fields[1], "last");
    LoopPrediction prediction;
    prediction.query = query;
    prediction.candidate = image_of(file, fields[2], "matched");
    const std::int64_t inliers = image_of(file, fields[4], "inliers").value();
    prediction.score = static_cast<double>(inliers);
    prediction.line = file.line();
    if ((first == FrameId(0) && last == FrameId(0)) || inliers == 0) continue;
    predictions.push_back(std::move(prediction));
  }
  return predictions;
}

std::vector<LoopPrediction> read_run(TextFile& file) {
  std::string_view line;
  std::vector<std::string_view> names, fields;
  if (!file.next(line)) throw FileError(file.path(), "is empty; expected loops.csv of a run");
  split_comma(line, names);
  const auto column = [&](std::string_view name) {
    const auto at = std::find(names.begin(), names.end(), name);
    if (at == names.end()) file.fail("no column " + std::string(name));
    return static_cast<std::size_t>(at - names.begin());
  };
  const std::size_t query = column("query"), match = column("match"), stage = column("stage"),
                    probability = column("probability"), columns = names.size();
  std::vector<LoopPrediction> predictions;
  while (file.next(line)) {
    split_comma(line, fields);
    if (fields.size() != columns)
      file.fail(std::to_string(fields.size()) + " columns, expected " + std::to_string(columns));
    LoopPrediction prediction;
    prediction.query = image_of(file, fields[query], "query");
    prediction.candidate = image_of(file, fields[match], "match");
    prediction.stage = fields[stage];
    prediction.score = file.number(fields[probability], "probability");
    if (prediction.score < 0 || prediction.score > 1)
      file.fail("probability: " + in_quotes(fields[probability]) + " is not in [0, 1]");
    prediction.line = file.line();
    predictions.push_back(std::move(prediction));
  }
  return predictions;
}

/// Errors of functions on arrays, as those of the file.
template <class Read>
std::vector<LoopPrediction> of_file(const std::string& path, const Read& read) {
  try {
    return read();
  } catch (const ArgumentError& error) {
    throw FileError(path, error.what());
  }
}

std::vector<std::int64_t> candidates_of(const NumberMatrix& matrix, const std::string& path) {
  std::vector<std::int64_t> candidates;
  for (const double value : matrix.values) {
    if (!(value >= -1 && value < kMaxImages) || value != std::floor(value))
      throw FileError(path, fmt::format("{} is not an image, and not -1 for none", value));
    candidates.push_back(static_cast<std::int64_t>(value));
  }
  return candidates;
}

LoopPredictionFile read_top_k(const std::string& path, const std::string& scores_path) {
  const NumberMatrix matrix = read_number_matrix(path);
  NumberMatrix scores;
  if (!scores_path.empty()) {
    scores = read_number_matrix(scores_path);
    if (scores.rows != matrix.rows || scores.columns != matrix.columns)
      throw FileError(scores_path,
                      fmt::format("has {} x {} scores, and {} has {} x {} candidates", scores.rows,
                                  scores.columns, path, matrix.rows, matrix.columns));
  }
  LoopPredictionFile result;
  result.predictions = of_file(path, [&] {
    return predictions_of_search(candidates_of(matrix, path), scores.values, matrix.columns);
  });
  result.form = fmt::format("{} candidates of {} queries, the best first", matrix.columns, matrix.rows);
  return result;
}

/// A `.npy` matrix of three columns: query, candidate, score.
LoopPredictionFile read_triples(const std::string& path) {
  const NumberMatrix matrix = read_number_matrix(path);
  if (matrix.columns != 3)
    throw FileError(path, fmt::format("has {} columns, expected query, candidate and score; "
                                      "candidates of a search are format topk, scores of all pairs "
                                      "format matrix",
                                      matrix.columns));
  LoopPredictionFile result;
  Distinct distinct;
  for (std::size_t row = 0; row < matrix.rows; ++row) {
    const double* values = &matrix.values[3 * row];
    LoopPrediction prediction;
    for (int i = 0; i < 2; ++i)
      if (!(values[i] >= 0 && values[i] < kMaxImages) || values[i] != std::floor(values[i]))
        throw FileError(path, fmt::format("row {}: {} is not an image", row, values[i]));
    prediction.query = FrameId(static_cast<std::int64_t>(values[0]));
    prediction.candidate = FrameId(static_cast<std::int64_t>(values[1]));
    prediction.score = values[2];
    if (!std::isfinite(prediction.score))
      throw FileError(path, fmt::format("row {}: the score is not finite", row));
    if (!distinct.add(prediction)) throw FileError(path, fmt::format("row {}: {}", row, named_twice(prediction)));
    result.predictions.push_back(std::move(prediction));
  }
  result.form = "rows of query, candidate and score";
  return result;
}

}  // namespace

std::vector<LoopPrediction> predictions_of_search(const std::vector<std::int64_t>& candidates,
                                                  const std::vector<double>& scores,
                                                  std::size_t columns) {
  require(columns > 0 && candidates.size() % columns == 0,
          "predictions_of_search: the candidates are no matrix of these columns");
  require(scores.empty() || scores.size() == candidates.size(),
          fmt::format("predictions_of_search: {} scores of {} candidates", scores.size(),
                      candidates.size()));
  std::vector<LoopPrediction> predictions;
  Distinct distinct;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (candidates[i] == -1) continue;
    const std::size_t query = i / columns, rank = i % columns;
    require(candidates[i] >= 0 && candidates[i] < kMaxImages,
            fmt::format("query {}: {} is not an image, and not -1 for none", query, candidates[i]));
    LoopPrediction prediction;
    prediction.query = FrameId(static_cast<std::int64_t>(query));
    prediction.candidate = FrameId(candidates[i]);
    prediction.score = scores.empty() ? -static_cast<double>(rank) - 1 : scores[i];
    require(std::isfinite(prediction.score),
            fmt::format("query {}: the score of candidate {} is not finite", query, candidates[i]));
    require(distinct.add(prediction), named_twice(prediction));
    predictions.push_back(std::move(prediction));
  }
  return predictions;
}

std::vector<LoopPrediction> predictions_of_matrix(const std::vector<double>& scores,
                                                  std::size_t columns) {
  require(columns > 0 && scores.size() % columns == 0,
          "predictions_of_matrix: the scores are no matrix of these columns");
  std::vector<LoopPrediction> predictions;
  for (std::size_t i = 0; i < scores.size(); ++i) {
    if (std::isnan(scores[i])) continue;
    require(std::isfinite(scores[i]), fmt::format("query {}: the score of candidate {} is infinite",
                                                  i / columns, i % columns));
    LoopPrediction prediction;
    prediction.query = FrameId(static_cast<std::int64_t>(i / columns));
    prediction.candidate = FrameId(static_cast<std::int64_t>(i % columns));
    prediction.score = scores[i];
    predictions.push_back(std::move(prediction));
  }
  return predictions;
}

LoopPredictionFile read_loop_prediction_file(const std::string& path,
                                             const LoopFileOptions& options) {
  LoopPredictionFile result;
  switch (options.format) {
    case LoopFileFormat::kIbow: {
      TextFile file(path);
      result.predictions = read_ibow(file);
      result.form = "output of iBoW-LCD";
      return result;
    }
    case LoopFileFormat::kRun: {
      TextFile file(path);
      result.predictions = read_run(file);
      result.scores = ScoreKind::kSimilarity;
      result.form = "loops.csv of a run";
      return result;
    }
    case LoopFileFormat::kTopK:
      return read_top_k(path, options.scores_of_top_k);
    case LoopFileFormat::kMatrix: {
      const NumberMatrix matrix = read_number_matrix(path);
      result.predictions =
          of_file(path, [&] { return predictions_of_matrix(matrix.values, matrix.columns); });
      result.form = fmt::format("a matrix of {} x {} scores", matrix.rows, matrix.columns);
      return result;
    }
    case LoopFileFormat::kScores:
      break;
  }
  return is_npy(path) ? read_triples(path) : read_table(path, options);
}

std::vector<LoopPrediction> read_loop_predictions(const std::string& path, LoopFileFormat format) {
  LoopFileOptions options;
  options.format = format;
  return read_loop_prediction_file(path, options).predictions;
}

void write_loop_predictions(const std::string& path,
                            const std::vector<LoopPrediction>& predictions) {
  AtomicFile file(path);
  for (const LoopPrediction& p : predictions)
    file.stream() << fmt::format("{} {} {:.9g}\n", p.query.value(), p.candidate.value(), p.score);
  file.commit();
}

}  // namespace placegraph
