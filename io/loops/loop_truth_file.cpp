#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/loops/delimited_table.h>
#include <placegraph/io/loops/loop_file.h>
#include <placegraph/io/loops/number_matrix.h>

#include <algorithm>
#include <utility>

namespace placegraph {
namespace {

constexpr std::int64_t kNone = -1;  // represents `-`

using LoopRow = std::vector<std::int64_t>;

struct TruthTable {
  std::vector<LoopRow> rows;
  std::vector<int> lines;
  bool has_none = false, has_header = false;
};

LoopRow row_of(const TextFile& file, const std::vector<std::string_view>& fields) {
  LoopRow row;
  for (const std::string_view field : fields) {
    if (field == "-") {
      if (row.size() != 3 || fields.size() != 4)
        file.fail("'-' stands for no match, after an image and its first and last candidate");
      row.push_back(kNone);
      continue;
    }
    const auto image = parse_whole(field);
    if (!image) file.fail("image: " + in_quotes(field) + " is not a whole number");
    if (*image < 0 || *image >= kMaxImages)
      file.fail("image: " + in_quotes(field) + " is not an image");
    row.push_back(*image);
  }
  return row;
}

TruthTable read_truth_table(const std::string& path) {
  DelimitedTable table(path);
  TruthTable result;
  result.has_header = !table.header().empty();
  std::vector<std::string_view> fields;
  while (table.next(fields)) {
    result.rows.push_back(row_of(table.file(), fields));
    result.lines.push_back(table.file().line());
    result.has_none |= result.rows.back().back() == kNone;
  }
  if (result.rows.empty()) throw FileError(path, "no ground truth in it");
  return result;
}

bool is_match(std::int64_t value) { return value == 0 || value == 1; }

/// Rows of equal length of 0 and 1. Two columns may be lists of one match each, and so may be one
/// row: only more make a matrix.
bool is_matrix(const TruthTable& table) {
  const std::size_t columns = table.rows.front().size();
  if (columns < 2 || table.rows.size() < 2) return false;
  if (!std::all_of(table.rows.front().begin(), table.rows.front().end(), is_match)) return false;
  if (columns == table.rows.size()) return true;
  // Lists begin with images that ascend: of 0 and 1 alone there are two at most.
  return columns > 2 && table.rows.size() > 2 &&
         std::all_of(table.rows.begin(), table.rows.end(), [&](const LoopRow& row) {
           return row.size() == columns && std::all_of(row.begin(), row.end(), is_match);
         });
}

// The images of a list ascend; in a line of ranges the first match is not beyond the last
// candidate.
bool are_ranges(const TruthTable& table) {
  if (table.has_none) return true;
  for (const LoopRow& row : table.rows) {
    if (row.size() < 3) return false;
    if (row.size() > 3) return row[3] <= row[2];
  }
  return false;
}

LoopTruth truth_of_table(const TruthTable& table, const std::string& path) {
  const std::size_t columns = table.rows.front().size();
  std::vector<bool> matches;
  for (std::size_t q = 0; q < table.rows.size(); ++q) {
    const LoopRow& row = table.rows[q];
    if (row.size() != columns)
      throw FileError(path, table.lines[q],
                      fmt::format("{} columns in a matrix of {} columns", row.size(), columns));
    for (const std::int64_t value : row) {
      if (!is_match(value))
        throw FileError(path, table.lines[q], std::to_string(value) + " in a matrix of 0 and 1");
      matches.push_back(value == 1);
    }
  }
  return loop_truth_of_matrix(matches, columns);
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

LoopTruthFile matrix_file(LoopTruth truth, std::size_t rows, std::size_t columns) {
  LoopTruthFile result;
  result.format = LoopTruthFormat::kMatrix;
  result.truth = std::move(truth);
  result.form = fmt::format("a matrix of {} x {} matches", rows, columns);
  return result;
}

LoopTruthFile read_npy_truth(const std::string& path) {
  const NumberMatrix matrix = read_number_matrix(path);
  std::vector<bool> matches;
  for (std::size_t i = 0; i < matrix.values.size(); ++i) {
    if (matrix.values[i] != 0 && matrix.values[i] != 1)
      throw FileError(path, fmt::format("row {}: {} in a matrix of 0 and 1", i / matrix.columns,
                                        matrix.values[i]));
    matches.push_back(matrix.values[i] == 1);
  }
  return matrix_file(loop_truth_of_matrix(matches, matrix.columns), matrix.rows, matrix.columns);
}

LoopTruthFile read_rows(const TruthTable& table, const std::string& path) {
  LoopTruthFile result;
  const bool ranges = are_ranges(table);
  result.format = ranges ? LoopTruthFormat::kRanges : LoopTruthFormat::kLists;
  result.form = ranges ? "matches and candidates listed per query" : "matches listed per query";
  result.truth.unlisted_have_none = !ranges;
  bool older = true;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    LoopQuery query = query_of_row(table.rows[i], ranges, path, table.lines[i]);
    const FrameId id(table.rows[i][0]);
    older &= query.last < id;
    if (!result.truth.queries.emplace(id, std::move(query)).second)
      throw FileError(path, table.lines[i], "image " + to_string(id) + " is listed already");
  }
  if (ranges)
    result.truth.protocol = older ? LoopProtocol::kWithinDrive : LoopProtocol::kQueryDatabase;
  return result;
}

}  // namespace

LoopTruthFile read_loop_truth(const std::string& path) {
  if (is_npy(path)) return read_npy_truth(path);
  const TruthTable table = read_truth_table(path);
  if (table.has_header || is_matrix(table)) {
    LoopTruth truth = truth_of_table(table, path);
    return matrix_file(std::move(truth), table.rows.size(), table.rows.front().size());
  }
  return read_rows(table, path);
}

}  // namespace placegraph
