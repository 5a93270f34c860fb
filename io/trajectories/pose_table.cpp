#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/trajectories/pose_header.h>
#include <placegraph/io/trajectories/pose_table.h>

#include <algorithm>
#include <numeric>

namespace placegraph {
namespace {

using Fields = std::vector<std::string_view>;

constexpr int kSampledLines = 50;
/// 1973 in nanoseconds since 1970: times in other units are smaller.
constexpr double kLeastNanosecondsSince1970 = 1e17;

constexpr const char* kForms =
    "readable are 12 or 16 numbers (KITTI; 13 or 17 with the number of the frame), 8 (TUM: t x y z "
    "qx qy qz qw; 9 with an id, or with whole seconds and nanoseconds; EuRoC: t_ns,x,y,z,qw,qx,qy,qz,...), 4 (t x y z), 3 (x y z), or the "
    "columns that a header names";

/// A possible format of a table.
struct Form {
  PoseColumns columns;
  bool certain = true;  ///< no other format has as many fields
};

PoseColumns quaternion_columns(std::size_t fields, std::optional<std::size_t> stamp,
                               bool scalar_first = false) {
  const std::size_t first = stamp ? *stamp + 1 : 0;
  PoseColumns columns;
  columns.fields = fields;
  columns.stamp = stamp;
  columns.position = {first, first + 1, first + 2};
  columns.quaternion = scalar_first ? std::array{first + 3, first + 4, first + 5, first + 6}
                                    : std::array{first + 6, first + 3, first + 4, first + 5};
  return columns;
}

PoseColumns position_columns(std::size_t fields, std::optional<std::size_t> stamp) {
  PoseColumns columns = quaternion_columns(fields, stamp);
  columns.quaternion.reset();
  return columns;
}

PoseColumns matrix_columns(std::size_t fields, std::optional<std::size_t> stamp) {
  const std::size_t first = stamp ? 1 : 0;
  PoseColumns columns;
  columns.fields = fields;
  columns.stamp = stamp;
  columns.matrix.emplace();
  std::iota(columns.matrix->begin(), columns.matrix->end(), first);
  if (fields == first + 16) columns.last_row = {first + 12, first + 13, first + 14, first + 15};
  return columns;
}

/// The unit of a column of stamps without a unit in the header.
StampUnit unit_of(const std::vector<Fields>& lines, std::size_t column, char separator,
                  bool may_be_number) {
  bool whole = true, since_1970 = true;
  for (const Fields& fields : lines) {
    if (column >= fields.size()) continue;
    const std::string_view field = fields[column];
    whole &= std::all_of(field.begin(), field.end(),
                         [](char c) { return is_digit(c) || c == '-' || c == '+'; });
    since_1970 &= parse_double(field).value_or(0) >= kLeastNanosecondsSince1970;
  }
  if (since_1970) return StampUnit::kNanoseconds;
  if (whole && may_be_number) return StampUnit::kFrameNumber;
  return whole && separator != ' ' ? StampUnit::kNanoseconds : StampUnit::kSeconds;
}

/// Whether the first lines have whole seconds in one column and less than one in nanoseconds in
/// the other.
bool is_in_two_columns(const std::vector<Fields>& lines, const PoseColumns& columns) {
  return std::ranges::all_of(lines, [&](const Fields& fields) {
    if (std::max(*columns.stamp, *columns.nanoseconds) >= fields.size()) return true;
    const auto s = parse_integer(fields[*columns.stamp]);
    const auto ns = parse_integer(fields[*columns.nanoseconds]);
    return s && ns && *ns < 1'000'000'000;
  });
}

/// Whether the first two columns of lines without a header are one time.
///
/// Both are whole; the seconds are of an epoch, or one second has several lines of milliseconds and
/// more, so that the first column is no number of the line.
bool begin_with_two_columns(const std::vector<Fields>& lines) {
  PoseColumns columns;
  columns.stamp = 0;
  columns.nanoseconds = 1;
  if (!is_in_two_columns(lines, columns)) return false;
  // 1973 in seconds since 1970.
  bool epoch = true, repeated = false, milliseconds = false;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].size() < 2) continue;
    epoch &= *parse_integer(lines[i][0]) >= 100'000'000;
    repeated |= i > 0 && lines[i][0] == lines[i - 1][0];
    milliseconds |= *parse_integer(lines[i][1]) >= 1'000'000;
  }
  return epoch || (repeated && milliseconds);
}

/// The formats of tables without a header whose lines have as many fields as the first.
std::vector<Form> forms_of(const std::vector<Fields>& lines, char separator) {
  const std::size_t n = lines.front().size();
  std::vector<Form> forms;
  const auto add = [&](PoseColumns columns, bool certain, bool may_be_number = false) {
    columns.separator = separator;
    if (columns.stamp) columns.unit = unit_of(lines, *columns.stamp, separator, may_be_number);
    forms.push_back({columns, certain});
  };
  const bool blanks = separator == ' ';
  if ((n == 5 || n == 9) && begin_with_two_columns(lines)) {
    PoseColumns columns = n == 5 ? position_columns(n, 1) : quaternion_columns(n, 1);
    columns.separator = separator;
    columns.stamp = 0;
    columns.nanoseconds = 1;
    columns.unit = StampUnit::kSeconds;
    forms.push_back({columns, false});
  }
  if (n == 3) add(position_columns(n, std::nullopt), true);
  if (n == 4) add(position_columns(n, 0), true);
  if (n == 7) add(quaternion_columns(n, std::nullopt), false);
  if (n == 12 || n == 16) add(matrix_columns(n, std::nullopt), blanks);
  if (n == 13 || n == 17) add(matrix_columns(n, 0), blanks, true);
  if (blanks && n == 8) add(quaternion_columns(n, 0), true);
  if (blanks && n == 9) {
    add(quaternion_columns(n, 0), false);
    add(quaternion_columns(n, 1), false);
  }
  if (!blanks && n >= 8) {
    // With nanoseconds EuRoC's order, whose scalar is first; with seconds TUM's.
    const bool nanoseconds = unit_of(lines, 0, separator, false) == StampUnit::kNanoseconds;
    PoseColumns columns = quaternion_columns(8, 0, nanoseconds);
    columns.more = true;
    add(columns, forms.empty());
  }
  return forms;
}

std::string count_of(std::size_t fields, char separator) {
  return fmt::format("{} fields between {}", fields,
                     separator == ' '   ? "blanks"
                     : separator == ',' ? "commas"
                                        : "semicolons");
}

char separator_of(std::string_view line) {
  for (const char c : {';', ','})
    if (line.find(c) != line.npos) return c;
  return ' ';
}

/// Whether a line is a comment; `%` begins one, too, in tables.
bool is_comment(std::string_view line) {
  const std::size_t begin = line.find_first_not_of(" \t\r");
  return begin == line.npos || line[begin] == '#' || line[begin] == '%';
}

/// The first lines of a table, and the lines before them.
struct Sample {
  struct Remark {
    std::string_view text;
    int line;
  };
  std::vector<Remark> remarks;  ///< comments, and a first line without numbers
  bool words = false;           ///< the last remark is a line without `#`
  std::vector<Fields> lines;
  std::string_view first;
  char separator = ' ';

  explicit Sample(TextFile& file) {
    std::string_view line;
    while (lines.empty() && file.next(line)) {
      if (is_comment(line)) {
        remarks.push_back({line, file.line()});
        continue;
      }
      add(without_comment(line));
      if (!words && !parse_double(lines.front().front())) {
        remarks.push_back({line, file.line()});
        words = true;
        lines.clear();
      }
    }
    while (lines.size() < kSampledLines && file.next_data(line))
      if (!is_comment(line)) add(line);
    file.rewind();
  }

 private:
  void add(std::string_view line) {
    if (lines.empty()) {
      first = line;
      separator = separator_of(line);
    }
    lines.emplace_back();
    split_fields(separator, line, lines.back());
  }
};

}  // namespace

PoseTable::PoseTable(TextFile file) : file_(std::move(file)) { find_columns(); }

bool PoseTable::next_line(std::string_view& line) {
  while (file_.next_data(line))
    if (file_.line() >= first_line_ && line.front() != '%') return true;
  return false;
}

bool PoseTable::next(PoseLine& pose) {
  std::string_view line;
  if (!next_line(line)) return false;
  split_fields(columns_.separator, line, fields_);
  pose = columns_.parse(file_, fields_);
  return true;
}

std::string PoseTable::why_not(const PoseColumns& columns) {
  std::string reason;
  try {
    std::string_view line;
    for (int i = 0; i < kSampledLines && next_line(line); ++i) {
      split_fields(columns.separator, line, fields_);
      columns.parse(file_, fields_);
    }
  } catch (const FileError& error) {
    const std::string place = file_.path() + ":" + std::to_string(file_.line()) + ": ";
    reason =
        fmt::format("line {}: {}", file_.line(), std::string(error.what()).substr(place.size()));
  }
  file_.rewind();
  return reason;
}

void PoseTable::find_columns() {
  const Sample sample(file_);
  const std::size_t fields = sample.lines.empty() ? 0 : sample.lines.front().size();
  for (const Sample::Remark& remark : sample.remarks) {
    const bool words = sample.words && &remark == &sample.remarks.back();
    const PoseHeader header = parse_pose_header(remark.text, fields);
    if (words) first_line_ = remark.line + 1;
    if (header.kind == PoseHeader::Kind::kRefused && fields > 0)
      throw FileError(file_.path(), remark.line, header.reason);
    if (words && header.kind == PoseHeader::Kind::kNone)
      throw FileError(file_.path(), remark.line,
                      "is no trajectory: " + in_quotes(remark.text) +
                          " is neither numbers nor a header that names x, y and z; " + kForms);
    if (header.kind != PoseHeader::Kind::kColumns || fields == 0) continue;
    columns_ = header.columns;
    columns_.separator = sample.separator;
    columns_.fields = fields;
    // The same time twice, in seconds and in nanoseconds, is no time in two columns.
    if (columns_.nanoseconds && !is_in_two_columns(sample.lines, columns_))
      columns_.nanoseconds.reset();
    if (columns_.stamp && columns_.unit == StampUnit::kUnknown)
      columns_.unit = unit_of(sample.lines, *columns_.stamp, sample.separator, false);
  }
  if (fields == 0) throw FileError(file_.path(), "holds no poses");
  if (columns_.fields > 0) return;

  const std::vector<Form> forms = forms_of(sample.lines, sample.separator);
  std::string attempts;
  for (const Form& form : forms) {
    const std::string reason = form.certain ? "" : why_not(form.columns);
    if (reason.empty()) {
      columns_ = form.columns;
      return;
    }
    attempts += fmt::format("; as {}: {}", form.columns.text(), reason);
  }
  std::string_view line;
  next_line(line);
  file_.fail("is no trajectory: " + count_of(fields, sample.separator) + ", " + in_quotes(line) +
             (attempts.empty() ? std::string("; ") + kForms : attempts));
}

}  // namespace placegraph
