#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/atomic_file.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/measurements/loop_file.h>

#include <algorithm>
#include <set>
#include <utility>

namespace placegraph {
namespace {

constexpr std::int64_t kMaxImages = 1'000'000'000;

FrameId image_of(const TextFile& file, std::string_view field, const char* what) {
  const std::int64_t image = file.integer(field, what);
  if (image < 0 || image >= kMaxImages)
    file.fail(std::string(what) + ": " + in_quotes(field) + " is not an image");
  return FrameId(image);
}

std::vector<LoopPrediction> read_scores(TextFile& file) {
  std::vector<LoopPrediction> predictions;
  std::set<std::pair<FrameId, FrameId>> seen;
  std::string_view line;
  std::vector<std::string_view> fields;
  while (file.next_data(line)) {
    split_blank(line, fields);
    if (fields.size() < 3 || fields.size() > 4)
      file.fail(std::to_string(fields.size()) +
                " columns, expected: query candidate score [stage]");
    LoopPrediction prediction;
    prediction.query = image_of(file, fields[0], "query");
    prediction.candidate = image_of(file, fields[1], "candidate");
    prediction.score = file.number(fields[2], "score");
    if (fields.size() == 4) prediction.stage = fields[3];
    prediction.line = file.line();
    if (!seen.emplace(prediction.query, prediction.candidate).second)
      file.fail("query " + to_string(prediction.query) + " has candidate " +
                to_string(prediction.candidate) + " already");
    predictions.push_back(std::move(prediction));
  }
  return predictions;
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

using LoopRow = std::vector<std::int64_t>;
constexpr std::int64_t kNone = -1;  // represents `-`

struct Table {
  std::vector<LoopRow> rows;
  std::vector<int> lines;
  bool has_none = false;
};

Table read_table(TextFile& file) {
  Table table;
  std::string_view line;
  std::vector<std::string_view> fields;
  while (file.next_data(line)) {
    if (line.find(',') != std::string_view::npos)
      split_comma(line, fields);
    else
      split_blank(line, fields);
    LoopRow row;
    for (const std::string_view field : fields) {
      if (field == "-") {
        if (row.size() != 3 || fields.size() != 4)
          file.fail("'-' stands for no match, after an image and its first and last candidate");
        table.has_none = true;
        row.push_back(kNone);
      } else {
        row.push_back(image_of(file, field, "image").value());
      }
    }
    table.rows.push_back(std::move(row));
    table.lines.push_back(file.line());
  }
  if (table.rows.empty()) throw FileError(file.path(), "no ground truth in it");
  return table;
}

bool is_matrix(const Table& table) {
  if (table.rows.size() < 2 || table.rows.front().size() != table.rows.size()) return false;
  for (const std::int64_t value : table.rows.front())
    if (value != 0 && value != 1) return false;
  return true;
}

// The images of a list ascend; in a line of ranges the first match is not beyond the last
// candidate.
bool are_ranges(const Table& table) {
  if (table.has_none) return true;
  for (const LoopRow& row : table.rows) {
    if (row.size() < 3) return false;
    if (row.size() > 3) return row[3] <= row[2];
  }
  return false;
}

LoopTruth read_matrix(const Table& table, const std::string& path) {
  LoopTruth truth;
  for (std::size_t q = 0; q < table.rows.size(); ++q) {
    const LoopRow& row = table.rows[q];
    if (row.size() != table.rows.size())
      throw FileError(path, table.lines[q],
                      std::to_string(row.size()) + " columns in a matrix of " +
                          std::to_string(table.rows.size()) + " lines");
    LoopQuery query;
    for (std::size_t m = 0; m < row.size(); ++m) {
      if (row[m] != 0 && row[m] != 1)
        throw FileError(path, table.lines[q], std::to_string(row[m]) + " in a matrix of 0 and 1");
      if (row[m] == 1 && m != q) query.matches.push_back(FrameId(m));
    }
    truth.queries.emplace(FrameId(q), std::move(query));
  }
  return truth;
}

LoopQuery query_of_row(const LoopRow& row, bool ranges, const std::string& path, int line) {
  LoopQuery query;
  if (ranges) {
    if (row.size() < 4) throw FileError(path, line, "expected: query first last matches, or -");
    query.first = FrameId(row[1]);
    query.last = FrameId(row[2]);
    if (query.last < query.first)
      throw FileError(path, line, "the candidates end before they begin");
  }
  for (std::size_t i = ranges ? 3 : 1; i < row.size(); ++i) {
    if (row[i] == kNone) continue;
    const FrameId match(row[i]);
    if (match < query.first || match > query.last)
      throw FileError(path, line,
                      "match " + to_string(match) + " is not among the candidates " +
                          to_string(query.first) + " to " + to_string(query.last));
    if (!query.matches.empty() && match <= query.matches.back())
      throw FileError(path, line, "the matches do not ascend");
    query.matches.push_back(match);
  }
  return query;
}

}  // namespace

std::vector<LoopPrediction> read_loop_predictions(const std::string& path, LoopFileFormat format) {
  TextFile file(path);
  switch (format) {
    case LoopFileFormat::kIbow:
      return read_ibow(file);
    case LoopFileFormat::kRun:
      return read_run(file);
    case LoopFileFormat::kScores:
      break;
  }
  return read_scores(file);
}

void write_loop_predictions(const std::string& path,
                            const std::vector<LoopPrediction>& predictions) {
  AtomicFile file(path);
  for (const LoopPrediction& p : predictions)
    file.stream() << fmt::format("{} {} {:.9g}\n", p.query.value(), p.candidate.value(), p.score);
  file.commit();
}

LoopTruthFile read_loop_truth(const std::string& path) {
  TextFile file(path);
  const Table table = read_table(file);
  LoopTruthFile result;
  if (is_matrix(table)) {
    result.format = LoopTruthFormat::kMatrix;
    result.truth = read_matrix(table, path);
    return result;
  }
  const bool ranges = are_ranges(table);
  result.format = ranges ? LoopTruthFormat::kRanges : LoopTruthFormat::kLists;
  result.truth.unlisted_have_none = !ranges;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    LoopQuery query = query_of_row(table.rows[i], ranges, path, table.lines[i]);
    if (!result.truth.queries.emplace(FrameId(table.rows[i][0]), std::move(query)).second)
      throw FileError(path, table.lines[i],
                      "image " + std::to_string(table.rows[i][0]) + " is listed already");
  }
  return result;
}

}  // namespace placegraph
