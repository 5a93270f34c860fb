#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/parallel.h>
#include <placegraph/io/files/text_file.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>

namespace placegraph {
namespace {

constexpr std::size_t kMaxFileBytes = std::size_t{1} << 31;

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f' || c == '\r'; }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

bool ends_a_field(char c) { return is_blank(c) || c == ',' || c == ';'; }

std::string read_whole(const std::string& path) {
  require_input_file(path);
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw FileError(path, "cannot be opened for reading");
  std::string text;
  std::error_code unknown;  // e.g. size of a pipe, which is read piece by piece from the begin
  const std::uintmax_t size = std::filesystem::file_size(path, unknown);
  std::size_t piece =
      unknown ? std::size_t{1} << 16 : std::min<std::size_t>(size, kMaxFileBytes) + 1;
  while (stream) {
    const std::size_t before = text.size();
    text.resize(before + piece);
    stream.read(text.data() + before, static_cast<std::streamsize>(piece));
    text.resize(before + static_cast<std::size_t>(stream.gcount()));
    if (text.size() > kMaxFileBytes) throw FileError(path, "is larger than 2 GiB");
    piece = std::max(piece, std::size_t{1} << 16);
  }
  if (stream.bad()) throw FileError(path, "cannot be read");
  return text;
}

}  // namespace

TextFile::TextFile(std::string path) : path_(std::move(path)), text_(read_whole(path_)) {
  const std::string_view text = text_;
  if (text.starts_with("\xEF\xBB\xBF")) begin_ = 3;
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
    throw FileError(path_, "is text in UTF-16: save it as UTF-8");
  rewind();
}

std::size_t TextFile::lines_left() const {
  const auto begin = text_.begin() + static_cast<std::ptrdiff_t>(std::min(position_, text_.size()));
  return 1 + static_cast<std::size_t>(std::count(begin, text_.end(), '\n'));
}

bool TextFile::next(std::string_view& line) {
  check_interruption();
  if (position_ >= text_.size()) return false;
  std::size_t end = text_.find('\n', position_);
  if (end == std::string::npos) end = text_.size();
  line = std::string_view(text_).substr(position_, end - position_);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  position_ = end + 1;
  ++line_;
  return true;
}

bool TextFile::next_data(std::string_view& line) {
  while (next(line)) {
    const std::string_view content = trimmed(line);
    if (content.empty() || content.front() == '#') continue;
    line = without_comment(line);
    return true;
  }
  return false;
}

void TextFile::fail(const std::string& message) const { throw FileError(path_, line_, message); }

double TextFile::number_or_nan(std::string_view field, const char* what) const {
  const std::optional<double> value = parse_double(field);
  if (!value) fail(std::string(what) + ": " + in_quotes(field) + " is not a number");
  if (std::isinf(*value)) fail(std::string(what) + ": " + in_quotes(field) + " is not finite");
  return *value;
}

double TextFile::number(std::string_view field, const char* what) const {
  const double value = number_or_nan(field, what);
  if (std::isnan(value)) fail(std::string(what) + ": " + in_quotes(field) + " is not finite");
  return value;
}

std::int64_t TextFile::integer(std::string_view field, const char* what) const {
  const std::optional<std::int64_t> value = parse_integer(field);
  if (!value) fail(std::string(what) + ": " + in_quotes(field) + " is not an integer of 64 bits");
  return *value;
}

std::int64_t TextFile::seconds_as_ns(std::string_view field, const char* what) const {
  const std::optional<std::int64_t> value = parse_seconds_as_ns(field);
  if (!value) {
    fail(std::string(what) + ": " + in_quotes(field) +
         " is not a time in seconds (a decimal number below 9.2e9)");
  }
  return *value;
}

std::string_view without_comment(std::string_view line) {
  for (std::size_t at = line.find('#'); at != line.npos; at = line.find('#', at + 1))
    if (at > 0 && ends_a_field(line[at - 1])) return trimmed(line.substr(0, at));
  return line;
}

void split_blank(std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  std::size_t begin = 0;
  while (begin < line.size()) {
    while (begin < line.size() && is_blank(line[begin])) ++begin;
    std::size_t end = begin;
    while (end < line.size() && !is_blank(line[end])) ++end;
    if (end > begin) fields.push_back(line.substr(begin, end - begin));
    begin = end;
  }
}

void split_at(char separator, std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  for (;;) {
    const std::size_t end = line.find(separator);
    fields.push_back(trimmed(line.substr(0, end)));
    if (end == std::string_view::npos) return;
    line.remove_prefix(end + 1);
  }
}

void split_comma(std::string_view line, std::vector<std::string_view>& fields) {
  split_at(',', line, fields);
}

namespace {

/// The number of a few digits alone, which is exact; nothing for any other field.
std::optional<double> few_digits(std::string_view field) {
  constexpr std::size_t kFew = 9;
  if (field.empty() || field.size() > kFew) return std::nullopt;
  int value = 0;
  for (const char c : field) {
    if (!is_digit(c)) return std::nullopt;
    value = 10 * value + (c - '0');
  }
  return value;
}

}  // namespace

std::optional<double> parse_double(std::string_view field) {
  if (const std::optional<double> digits = few_digits(field)) return digits;
  if (field.size() > 1 && field[0] == '+' && field[1] != '-') field.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (end != field.data() + field.size() || field.empty()) return std::nullopt;
  if (error == std::errc::result_out_of_range) {
    // Too small to be represented is zero; too large is no number.
    const double rounded = std::strtod(std::string(field).c_str(), nullptr);
    return std::abs(rounded) < 1 ? std::optional<double>(0) : std::nullopt;
  }
  if (error != std::errc()) return std::nullopt;
  return value;
}

std::optional<std::int64_t> parse_integer(std::string_view field) {
  if (field.size() > 1 && field[0] == '+' && field[1] != '-') field.remove_prefix(1);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size()) return std::nullopt;
  return value;
}

std::optional<std::int64_t> parse_decimal(std::string_view field, int power, bool* exact) {
  bool negative = false;
  if (!field.empty() && (field[0] == '-' || field[0] == '+')) {
    negative = field[0] == '-';
    field.remove_prefix(1);
  }
  std::string digits;
  int before_point = 0;
  bool any = false, point = false;
  std::size_t i = 0;
  for (; i < field.size() && (is_digit(field[i]) || (field[i] == '.' && !point)); ++i) {
    if (field[i] == '.') {
      point = true;
      continue;
    }
    any = true;
    if (digits.empty() && field[i] == '0') {  // leading zeros carry no digit
      if (point) --before_point;
      continue;
    }
    digits += field[i];
    if (!point) ++before_point;
  }
  if (!any) return std::nullopt;
  int exponent = 0;
  if (i < field.size()) {
    if (field[i] != 'e' && field[i] != 'E') return std::nullopt;
    std::string_view digits_of_power = field.substr(i + 1);
    if (!digits_of_power.empty() && digits_of_power[0] == '+') digits_of_power.remove_prefix(1);
    const auto [end, error] = std::from_chars(
        digits_of_power.data(), digits_of_power.data() + digits_of_power.size(), exponent);
    if (error != std::errc() || end != digits_of_power.data() + digits_of_power.size())
      return std::nullopt;
    if (std::abs(exponent) > 400) return std::nullopt;
  }
  if (exact) *exact = true;
  if (digits.empty()) return 0;
  // The number is 0.d1 d2 d3 ... times 10^point_at.
  const int point_at = before_point + exponent + power;
  if (point_at > 19) return std::nullopt;
  const auto kept = static_cast<std::size_t>(std::max(point_at, 0));
  if (exact)
    *exact = digits.find_last_not_of('0') == digits.npos || digits.find_last_not_of('0') < kept;
  if (point_at < 0) return 0;
  const bool round_up = digits.size() > kept && digits[kept] >= '5';
  digits.resize(kept, '0');
  std::int64_t value = 0;
  if (kept > 0) {
    const std::optional<std::int64_t> whole = parse_integer(digits);
    if (!whole) return std::nullopt;
    value = *whole;
  }
  if (round_up) {
    if (value == std::numeric_limits<std::int64_t>::max()) return std::nullopt;
    ++value;
  }
  return negative ? -value : value;
}

std::optional<std::int64_t> parse_seconds_as_ns(std::string_view field) {
  return parse_decimal(field, 9);
}

std::string in_quotes(std::string_view text) {
  std::string out = "'";
  for (const char c : text.substr(0, 40)) out += (c >= 32 && c < 127) ? c : '?';
  return out + (text.size() > 40 ? "...'" : "'");
}

std::vector<std::int64_t> read_times(const std::string& path) {
  TextFile file(path);
  std::vector<std::int64_t> stamps_ns;
  std::vector<std::string_view> fields;
  std::string_view line;
  while (file.next_data(line)) {
    split_blank(line, fields);
    if (fields.size() != 1) {
      file.fail("expected one time [s], found " + std::to_string(fields.size()) + " fields");
    }
    const std::int64_t stamp_ns = file.seconds_as_ns(fields[0], "time");
    if (!stamps_ns.empty() && stamp_ns <= stamps_ns.back()) {
      file.fail("time " + in_quotes(fields[0]) + " does not increase");
    }
    stamps_ns.push_back(stamp_ns);
  }
  if (stamps_ns.empty()) throw FileError(path, "holds no times");
  return stamps_ns;
}

}  // namespace placegraph
