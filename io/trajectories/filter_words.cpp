#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/trajectories/filter_words.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace placegraph {
namespace {

bool is_blank(std::string_view text) {
  return text.find_first_not_of(" \t\r\n") == text.npos;
}

}  // namespace

std::optional<Quantity> parse_quantity(std::string_view word) {
  const std::size_t end = word.find_last_of("0123456789.");
  if (end == word.npos) return std::nullopt;
  const std::optional<double> value = parse_double(word.substr(0, end + 1));
  if (!value || !std::isfinite(*value)) return std::nullopt;
  Quantity quantity{*value, std::string(word.substr(end + 1))};
  for (char& c : quantity.unit) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return quantity;
}

FilterWords::FilterWords(std::string_view step) {
  char quote = 0;
  bool begun = false;
  for (const char c : step) {
    if (quote != 0 ? c == quote : c == '\'' || c == '"') {
      quote = quote != 0 ? 0 : c;
      if (!begun) words_.emplace_back();
      begun = true;
    } else if (quote == 0 && is_blank(std::string_view(&c, 1))) {
      begun = false;
    } else {
      if (!begun) words_.emplace_back();
      begun = true;
      words_.back() += c;
    }
  }
  require(quote == 0, std::string("a quotation mark ") + quote + " is not closed");
}

const std::string& FilterWords::take(const char* what) {
  require(has_next(), std::string(what) + " is missing");
  return words_[next_++];
}

bool FilterWords::take_if(std::string_view word) {
  if (!has_next() || peek() != word) return false;
  ++next_;
  return true;
}

double FilterWords::number(const char* what) {
  const std::string& word = take(what);
  const std::optional<double> value = parse_double(word);
  require(value && std::isfinite(*value), std::string(what) + ": " + in_quotes(word) +
                                              " is not a number");
  return *value;
}

std::int64_t FilterWords::seconds_ns(const char* what) {
  const std::string& word = take(what);
  const std::optional<std::int64_t> value = parse_seconds_as_ns(word);
  require(value.has_value(), std::string(what) + ": " + in_quotes(word) + " is no time in seconds");
  return *value;
}

void FilterWords::end() const {
  require(!has_next(), in_quotes(peek()) + " is one word too many");
}

std::vector<std::string> split_chain(std::string_view chain) {
  std::vector<std::string> steps(1);
  char quote = 0;
  for (const char c : chain) {
    if (quote != 0 ? c == quote : c == '\'' || c == '"') quote = quote != 0 ? 0 : c;
    if (c == ';' && quote == 0)
      steps.emplace_back();
    else
      steps.back() += c;
  }
  std::erase_if(steps, [](const std::string& step) { return is_blank(step); });
  return steps;
}

}  // namespace placegraph
