#include <fmt/format.h>
#include <placegraph/io/loops/delimited_table.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

namespace placegraph {
namespace {

char separator_of(std::string_view line) {
  for (const char separator : {';', ',', '\t'})
    if (line.find(separator) != std::string_view::npos) return separator;
  return ' ';
}

std::string name_of(std::string_view field) {
  if (field.size() >= 2 && (field.front() == '"' || field.front() == '\'') &&
      field.back() == field.front())
    field = field.substr(1, field.size() - 2);
  std::string name(field);
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name;
}

}  // namespace

DelimitedTable::DelimitedTable(const std::string& path, IsName is_name) : file_(path) {
  find_header(is_name);
}

bool DelimitedTable::take_header(const std::vector<std::string_view>& fields, IsName is_name) {
  std::vector<std::string> names;
  for (const std::string_view field : fields) names.push_back(name_of(field));
  if (is_name && std::none_of(names.begin(), names.end(), is_name)) return false;
  header_ = std::move(names);
  header_line_ = file_.line();
  return true;
}

void DelimitedTable::split(std::string_view line, std::vector<std::string_view>& fields) const {
  if (separator_ == ' ')
    split_blank(line, fields);
  else
    split_at(separator_, line, fields);
  // A tab or separator at the end of a line is no field.
  while (separator_ != ' ' && fields.size() > 1 && fields.back().empty()) fields.pop_back();
}

void DelimitedTable::find_header(IsName is_name) {
  std::string_view line, remark;
  std::vector<std::string_view> fields;
  while (file_.next(line)) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t\r"), line.size()));
    if (line.empty()) continue;
    if (line.front() != '#' && line.front() != '%') break;
    remark = line.substr(1);
    line = {};
  }
  separator_ = separator_of(line);
  split(without_comment(line), fields);
  numbered_rows_ = fields.size() > 1 && fields.front().empty();
  if (numbered_rows_) fields.erase(fields.begin());
  const auto is_number = [](std::string_view field) { return parse_double(field).has_value(); };
  if (fields.empty() || std::none_of(fields.begin(), fields.end(), is_number)) {
    if (!fields.empty()) take_header(fields, is_name);
  } else if (is_name && !remark.empty()) {
    const std::size_t columns = fields.size();
    const char of_rows = std::exchange(separator_, separator_of(remark));
    split(remark, fields);
    separator_ = of_rows;
    if (fields.size() == columns && std::none_of(fields.begin(), fields.end(), is_number) &&
        take_header(fields, is_name))
      header_line_ = 0;  // a comment, which is passed over anyway
  }
  file_.rewind();
}

bool DelimitedTable::next(std::vector<std::string_view>& fields) {
  std::string_view line;
  do {
    if (!file_.next_data(line)) return false;
  } while (file_.line() <= header_line_);
  split(line, fields);
  if (numbered_rows_ && !fields.empty()) fields.erase(fields.begin());
  if (!header_.empty() && fields.size() != header_.size())
    file_.fail(fmt::format("{} columns, and the header names {}", fields.size(), header_.size()));
  return true;
}

std::optional<std::int64_t> parse_whole(std::string_view field) {
  if (const auto whole = parse_integer(field)) return whole;
  const auto number = parse_double(field);
  constexpr double kExact = 9007199254740992;  // 2^53: beyond it a double does not hold every integer
  if (!number || !(std::abs(*number) <= kExact) || *number != std::floor(*number))
    return std::nullopt;
  return static_cast<std::int64_t>(*number);
}

}  // namespace placegraph
