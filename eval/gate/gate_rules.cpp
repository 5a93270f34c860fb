#include <fmt/format.h>
#include <placegraph/eval/gate/gate_rules.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

namespace placegraph {
namespace {

constexpr const char* kGone = "(gone)";

/// What each `*` of a pattern stands for in a name, the first as long as possible.
std::optional<std::vector<std::string>> stars_of(std::string_view pattern, std::string_view name) {
  const std::size_t star = pattern.find('*');
  if (star == std::string_view::npos)
    return pattern == name ? std::optional(std::vector<std::string>()) : std::nullopt;
  if (!name.starts_with(pattern.substr(0, star))) return std::nullopt;
  const std::string_view rest = pattern.substr(star + 1), behind = name.substr(star);
  // A last star takes what is left, wherever it is enough to ask for the end.
  if (rest.find('*') == std::string_view::npos) {
    if (!behind.ends_with(rest)) return std::nullopt;
    return {{std::string(behind.substr(0, behind.size() - rest.size()))}};
  }
  for (std::size_t length = behind.size() + 1; length-- > 0;)
    if (auto stars = stars_of(rest, behind.substr(length))) {
      stars->insert(stars->begin(), std::string(behind.substr(0, length)));
      return stars;
    }
  return std::nullopt;
}

/// A new name, of which each `*` is what that of the old one stood for.
std::string filled(const std::string& name, const std::vector<std::string>& stars) {
  std::string text;
  auto star = stars.begin();
  for (const char c : name)
    if (c == '*' && star != stars.end())
      text += *star++;
    else
      text += c;
  return text;
}

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// The fields between bars, without the blanks around them.
std::vector<std::string> fields_of(const std::string& text) {
  std::vector<std::string> fields(1);
  for (const char c : text)
    if (c == '|')
      fields.emplace_back();
    else
      fields.back() += c;
  for (std::string& field : fields) field = trimmed(field);
  return fields;
}

/// Reads the words of one rule.
class RuleReader {
 public:
  RuleReader(const std::string& text, const std::string& source, int line)
      : text_(text), source_(source), line_(line) {
    std::string spaced = text;
    std::ranges::replace(spaced, ',', ' ');
    std::istringstream words(spaced);
    for (std::string word; words >> word;) words_.push_back(word);
  }

  GateRule read() {
    GateRule rule;
    rule.text = text_;
    if (words_.empty()) fail();
    if (!take_kind(rule)) fail();
    bool tolerance = rule.kind == GateRule::Kind::kTolerance;
    while (at_ < words_.size()) {
      if (take("whole")) {
        rule.whole_may_change = true;
      } else if (take("floor")) {
        rule.floor = number();
      } else if (rule.kind == GateRule::Kind::kSignificant && take("over")) {
        if (!take("sequences")) fail();
        rule.over_sequences = true;
      } else if (rule.kind == GateRule::Kind::kSignificant && !rule.otherwise && take("else")) {
        rule.otherwise = tolerance = true;
        take_direction(rule);
      } else if (rule.kind == GateRule::Kind::kSignificant && !tolerance) {
        rule.find = number() / 100;
        if (!take("%") || rule.find == 0) fail();
      } else if (tolerance) {
        const double value = number();
        (take("%") ? rule.relative : rule.absolute) = value;
        if (words_[at_ - 1] == "%") rule.relative /= 100;
      } else {
        fail();
      }
    }
    return rule;
  }

 private:
  [[noreturn]] void fail() const {
    throw FileError(source_, line_, "'" + text_ + "' is no rule; one is 'worse 2 % 0.001'");
  }
  bool take(const char* word) {
    if (at_ == words_.size() || words_[at_] != word) return false;
    ++at_;
    return true;
  }
  double number() {
    if (at_ == words_.size()) fail();
    const std::string& word = words_[at_++];
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value) ||
        value < 0)
      fail();
    return value;
  }
  bool take_direction(GateRule& rule) {
    if (take("worse")) return true;
    if (take("lower"))
      rule.better = Better::kSmaller;
    else if (take("higher"))
      rule.better = Better::kLarger;
    else if (take("zero"))
      rule.better = Better::kNearerZero;
    else if (take("equal"))
      rule.better = Better::kEqual;
    return rule.better.has_value();
  }
  bool take_kind(GateRule& rule) {
    if (take_direction(rule)) return true;
    if (take("significant"))
      rule.kind = GateRule::Kind::kSignificant;
    else if (take("info"))
      rule.kind = GateRule::Kind::kInfo;
    else if (take("time"))
      rule.kind = GateRule::Kind::kTime;
    else if (take("ignore"))
      rule.kind = GateRule::Kind::kIgnore;
    else
      return false;
    if (rule.kind == GateRule::Kind::kSignificant) take_direction(rule);
    return true;
  }

  std::string text_, source_;
  int line_;
  std::vector<std::string> words_;
  std::size_t at_ = 0;
};

GateRules::Rename parse_rename(const std::string& text, const std::string& source, int line) {
  const std::size_t arrow = text.find(" -> ");
  const std::vector<std::string> old = fields_of(text.substr(0, arrow));
  const std::string name = arrow == std::string::npos ? "" : trimmed(text.substr(arrow + 4));
  if (name.empty() || old.size() > 2 || std::ranges::count(old, "") > 0)
    throw FileError(source, line, "a rename is 'rename SEQUENCE | FIGURE -> NEW NAME'");
  GateRules::Rename rename{old.front(), std::nullopt, name};
  if (old.size() == 2) rename.figure = old.back();
  return rename;
}

void parse_line(const std::string& text, const std::string& source, int line, GateRules& rules) {
  if (text.starts_with("rename ")) {
    rules.renames.push_back(parse_rename(text.substr(7), source, line));
    return;
  }
  const bool must = text.starts_with("must ");
  const std::vector<std::string> fields = fields_of(must ? text.substr(5) : text);
  if (fields.size() != (must ? 2u : 3u) || std::ranges::count(fields, "") > 0)
    throw FileError(source, line,
                    must ? "a line is 'must SEQUENCE | FIGURE'"
                         : "a line is 'SEQUENCE | FIGURE | RULE'");
  if (must)
    rules.musts.push_back({fields[0], fields[1]});
  else
    rules.lines.push_back({fields[0], fields[1], RuleReader(fields[2], source, line).read()});
}

}  // namespace

bool fits_pattern(const std::string& pattern, const std::string& name) {
  return stars_of(pattern, name).has_value();
}

GateRule GateRules::rule_of(const std::string& sequence, const std::string& figure) const {
  for (const Line& line : lines)
    if (fits_pattern(line.sequence, sequence) && fits_pattern(line.figure, figure)) return line.rule;
  GateRule strict;
  strict.text = "worse 0";
  return strict;
}

std::optional<std::string> GateRules::sequence_now(const std::string& name) const {
  for (const Rename& rename : renames) {
    if (rename.figure) continue;
    const auto stars = stars_of(rename.sequence, name);
    if (stars) return rename.name == kGone ? std::nullopt : std::optional(filled(rename.name, *stars));
  }
  return name;
}

std::optional<std::string> GateRules::figure_now(const std::string& sequence,
                                                 const std::string& key) const {
  for (const Rename& rename : renames) {
    if (!rename.figure || !fits_pattern(rename.sequence, sequence)) continue;
    const auto stars = stars_of(*rename.figure, key);
    if (stars) return rename.name == kGone ? std::nullopt : std::optional(filled(rename.name, *stars));
  }
  return key;
}

GateRules parse_rules(const std::string& text, const std::string& source) {
  GateRules rules;
  std::istringstream lines(text);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    line = trimmed(line);
    if (!line.empty() && line[0] != '#') parse_line(line, source, number, rules);
  }
  return rules;
}

const std::string& default_rules_text() {
  // Details of a distribution follow its main figure. 5 %, and a hundredth of the poses: chosen.
  static const std::string text =
      "* | ate_percent_of_path | info\n"
      "* | *_mean_* | info\n"
      "* | *_median_* | info\n"
      "* | *_std_* | info\n"
      "* | *_min_* | info\n"
      "* | *_max_* | info\n"
      "* | *_sse_* | info\n"
      "* | *_p95_* | info\n"
      "* | *_heading_deg | info\n"
      "* | *_inclination_deg | info\n"
      "* | scale_drift* | info\n"
      "* | coverage | worse 0.01\n"
      "* | below_* | worse 0.01\n"
      "* | judged_frames | worse 5 %\n"
      "* | * | significant else worse 5 %\n";
  return text;
}

const GateRules& default_rules() {
  static const GateRules rules = parse_rules(default_rules_text(), "the default rules");
  return rules;
}

}  // namespace placegraph
