#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/text/spelling.h>
#include <placegraph/io/config/yaml_config.h>
#include <placegraph/io/config/yaml_document.h>
#include <placegraph/io/files/text_file.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <set>
#include <utility>

namespace placegraph {
namespace internal {
namespace {

/// Throws an error about the present key; the line is that of `node`.
using Fail = std::function<void(const YAML::Node& node, const std::string& message)>;

std::string joined(const std::vector<std::string>& prefix, std::string_view key) {
  std::string path;
  for (const std::string& part : prefix) path += part + ".";
  return path.append(key);
}

std::string seen(const YAML::Node& node) {
  if (node.IsScalar()) return in_quotes(node.Scalar());
  if (node.IsSequence()) return "a list";
  return node.IsMap() ? "a map" : "nothing";
}

void require_range(double value, Range range, const YAML::Node& node, const Fail& fail) {
  if (value >= range.min && value <= range.max) return;
  fail(node, fmt::format("{} lies outside [{}, {}]", seen(node), range.min, range.max));
}

/// Whether a node is a plain scalar; quoted ones are always texts.
bool is_plain(const YAML::Node& node) { return node.IsScalar() && node.Tag() != "!"; }

template <class Integer>
bool parse_whole(const YAML::Node& node, Integer& value) {
  if (!is_plain(node)) return false;
  const std::string& text = node.Scalar();
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

void assign(const YAML::Node& node, bool& value, const Fail& fail) {
  const bool known = is_plain(node) && (node.Scalar() == "true" || node.Scalar() == "false");
  if (!known) fail(node, "expected true or false, found " + seen(node));
  value = node.Scalar() == "true";
}

void assign(const YAML::Node& node, int& value, Range range, const Fail& fail) {
  int parsed = 0;
  if (!parse_whole(node, parsed)) fail(node, "expected an integer, found " + seen(node));
  require_range(parsed, range, node, fail);
  value = parsed;
}

void assign(const YAML::Node& node, std::uint64_t& value, const Fail& fail) {
  std::uint64_t parsed = 0;
  if (!parse_whole(node, parsed)) fail(node, "expected an integer from 0, found " + seen(node));
  value = parsed;
}

void assign(const YAML::Node& node, double& value, Range range, const Fail& fail) {
  const std::optional<double> parsed = yaml_number(node);
  if (!parsed) fail(node, "expected a number, found " + seen(node));
  require_range(*parsed, range, node, fail);
  value = *parsed;
}

void assign(const YAML::Node& node, std::string& value, const Fail& fail) {
  if (!node.IsScalar()) fail(node, "expected a text, found " + seen(node));
  value = node.Scalar();
}

void assign(const YAML::Node& node, std::vector<double>& value, Range range, const Fail& fail) {
  if (!node.IsSequence()) fail(node, "expected a list [a, b, ...], found " + seen(node));
  std::vector<double> parsed;
  for (const YAML::Node& element : node) assign(element, parsed.emplace_back(), range, fail);
  value = std::move(parsed);
}

void assign_choice(const YAML::Node& node, int& index, const std::vector<std::string>& names,
                   const Fail& fail) {
  const auto match = node.IsScalar() ? std::ranges::find(names, node.Scalar()) : names.end();
  if (match == names.end()) {
    fail(node, fmt::format("expected one of {}, found {}", fmt::join(names, " | "), seen(node)));
  }
  index = static_cast<int>(match - names.begin());
}

}  // namespace

/// Base of the visitors that assign values: all seven overloads find the value of a key and assign
/// it.
class AssigningVisitor : public OptionVisitor {
 public:
  void operator()(const char* key, bool& value, const char*) override {
    take(key, [&](const YAML::Node& node, const Fail& fail) { assign(node, value, fail); });
  }
  void operator()(const char* key, int& value, const char*, Range range) override {
    take(key, [&](const YAML::Node& node, const Fail& fail) { assign(node, value, range, fail); });
  }
  void operator()(const char* key, std::uint64_t& value, const char*) override {
    take(key, [&](const YAML::Node& node, const Fail& fail) { assign(node, value, fail); });
  }
  void operator()(const char* key, double& value, const char*, Range range) override {
    take(key, [&](const YAML::Node& node, const Fail& fail) { assign(node, value, range, fail); });
  }
  void operator()(const char* key, std::string& value, const char*) override {
    take(key, [&](const YAML::Node& node, const Fail& fail) { assign(node, value, fail); });
  }
  void operator()(const char* key, std::vector<double>& value, const char*, Range range) override {
    take(key, [&](const YAML::Node& node, const Fail& fail) { assign(node, value, range, fail); });
  }

  /// Lines about old spellings and retired keys that were used.
  std::vector<std::string> notes;

 protected:
  void note_spelling(const std::string& place, const std::string& former, const std::string& path) {
    notes.push_back(fmt::format("{}'{}' is an old spelling of '{}'", place, former, path));
  }

  void note_retired(const std::string& place, const std::string& path, double value) {
    notes.push_back(fmt::format("{}'{}' is a constant now, {}; the value here is not used", place,
                                path, value));
  }

  using Assign = std::function<void(const YAML::Node&, const Fail&)>;
  /// Calls `assign` with the value of `key`, if there is one.
  virtual void take(const char* key, const Assign& assign) = 0;

  void choice_index(const char* key, int& index, const std::vector<std::string>& names,
                    const char*) override {
    take(key, [&](const YAML::Node& node, const Fail& fail) {
      assign_choice(node, index, names, fail);
    });
  }
};

class OptionsFile::Reader : public AssigningVisitor {
 public:
  explicit Reader(const std::string& path) : document_(path) { enter(document_.root()); }
  Reader(const std::string& path, const std::string& text) : document_(path, text) {
    enter(document_.root());
  }

  void finish() {
    leave();
    if (unknown_) throw *unknown_;
  }

  void retired(const std::vector<RetiredOption>& keys, const char* group) override {
    if (group != nullptr) {
      const YAML::Node value = find(group, nullptr);
      prefix_.emplace_back(group);
      enter(value.IsDefined() ? value : YAML::Node());
    }
    for (const RetiredOption& each : keys) {
      levels_.back().former.emplace_back(each.key);
      const YAML::Node value = value_of(each.key);
      if (value.IsDefined())
        note_retired(fmt::format("{}:{}: ", document_.path(), yaml_line(value)),
                     joined(prefix_, each.key), each.value);
    }
    if (group != nullptr) end_group();
  }

 private:
  struct Level {
    YAML::Node map;
    std::vector<std::string> known, former;  ///< keys that are asked for
  };

  void take(const char* key, const Assign& assign) override {
    const YAML::Node value = find(key, take_marks().former_key);
    if (!value.IsDefined()) return;
    const std::string path = joined(prefix_, key);
    assign(value, [this, &path](const YAML::Node& node, const std::string& message) {
      document_.fail(node, path + ": " + message);
    });
  }

  /// The value of a key, which may have its former spelling; both at once are an error.
  YAML::Node find(const char* key, const char* former) {
    levels_.back().known.emplace_back(key);
    const YAML::Node present = value_of(key);
    if (former == nullptr) return present;
    levels_.back().former.emplace_back(former);
    const YAML::Node old = value_of(former);
    if (!old.IsDefined()) return present;
    const std::string spelled = joined(prefix_, former), path = joined(prefix_, key);
    if (present.IsDefined())
      document_.fail(old, spelled + ": is an old spelling of " + path + ", which is also there");
    note_spelling(fmt::format("{}:{}: ", document_.path(), yaml_line(old)), spelled, path);
    return old;
  }

  YAML::Node value_of(const char* key) const {
    const YAML::Node& map = levels_.back().map;
    return map.IsMap() ? map[key] : YAML::Node(YAML::NodeType::Undefined);
  }

  void begin_group(const char* key, const char*) override {
    const YAML::Node value = find(key, take_marks().former_key);
    prefix_.emplace_back(key);
    enter(value.IsDefined() ? value : YAML::Node());
  }

  void end_group() override {
    leave();
    prefix_.pop_back();
  }

  void enter(const YAML::Node& node) {
    if (!node.IsNull() && !node.IsMap()) {
      const std::string name =
          prefix_.empty() ? "the file" : fmt::format("{}", fmt::join(prefix_, "."));
      document_.fail(node, name + ": expected keys and values, found " + seen(node));
    }
    std::set<std::string> keys;
    for (const auto& entry : node) {
      if (!entry.first.IsScalar()) document_.fail(entry.first, "a key is not a text");
      const std::string& key = entry.first.Scalar();
      if (!keys.insert(key).second) {
        document_.fail(entry.first, joined(prefix_, key) + ": duplicate key");
      }
    }
    levels_.push_back({node, {}, {}});
  }

  /// Records the first unknown key of the file; it is thrown at the end, after wrong values.
  void leave() {
    for (const auto& entry : levels_.back().map) {
      const std::string& key = entry.first.Scalar();
      const Level& level = levels_.back();
      if (std::ranges::count(level.known, key) + std::ranges::count(level.former, key) > 0)
        continue;
      const int line = yaml_line(entry.first);
      if (unknown_ && unknown_line_ <= line) continue;
      unknown_line_ = line;
      unknown_.emplace(document_.path(), line,
                       joined(prefix_, key) + ": unknown key" + did_you_mean(key, level.known));
    }
    levels_.pop_back();
  }

  YamlDocument document_;
  std::vector<Level> levels_;
  std::vector<std::string> prefix_;
  std::optional<FileError> unknown_;
  int unknown_line_ = 0;
};

OptionsFile::OptionsFile(const std::string& path) : reader_(std::make_unique<Reader>(path)) {}
OptionsFile::OptionsFile(const std::string& path, const std::string& text)
    : reader_(std::make_unique<Reader>(path, text)) {}
OptionsFile::~OptionsFile() = default;
OptionVisitor& OptionsFile::visitor() { return *reader_; }
void OptionsFile::finish(const LogSink& log) {
  reader_->finish();
  if (log)
    for (const std::string& note : reader_->notes) log(LogLevel::kWarning, note);
}

class OptionAssignment::Setter : public AssigningVisitor {
 public:
  explicit Setter(const std::string& assignment) : assignment_(assignment) {
    const std::size_t equals = assignment.find('=');
    if (equals == std::string::npos || equals == 0) fail("expected key=value");
    key_ = assignment.substr(0, equals);
    for (std::size_t begin = 0, end = 0; end != std::string::npos; begin = end + 1) {
      end = key_.find('.', begin);
      words_.push_back(key_.substr(begin, end - begin));
    }
    try {
      value_ = YAML::Load(assignment.substr(equals + 1));
    } catch (const YAML::Exception& error) {
      fail("the value is not YAML: " + error.msg);
    }
  }

  void retired(const std::vector<RetiredOption>& keys, const char* group) override {
    if (group != nullptr) begin_group(group, "");
    for (const RetiredOption& each : keys) {
      if (!is_spelled(each.key, nullptr, prefix_.size() + 1)) continue;
      note_retired("--set ", key_, each.value);
      assigned_ = true;
    }
    if (group != nullptr) end_group();
  }

  void finish(const std::vector<OptionEntry>& known) const {
    if (assigned_) return;
    if (group_) fail("is a group of options, not one");
    std::string message = "unknown key";
    const std::vector<std::string> near = near_matches(known);
    if (!near.empty()) message += fmt::format("; similar: {}", fmt::join(near, ", "));
    fail(message);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw ArgumentError("--set " + assignment_ + ": " + message);
  }

  void take(const char* key, const Assign& assign) override {
    if (!is_spelled(key, take_marks().former_key, prefix_.size() + 1)) return;
    assign(value_, [this](const YAML::Node&, const std::string& message) { fail(message); });
    assigned_ = true;
  }

  void begin_group(const char* key, const char*) override {
    const char* former = take_marks().former_key;
    group_ = group_ || is_spelled(key, former, prefix_.size() + 1);
    prefix_.emplace_back(key);
    former_prefix_.emplace_back(former != nullptr ? former : key);
  }
  void end_group() override {
    prefix_.pop_back();
    former_prefix_.pop_back();
  }

  /// Whether the key that is set, of `length` words, names `key` in the present group; each word
  /// may have its former spelling.
  bool is_spelled(const char* key, const char* former, std::size_t length) {
    if (words_.size() != length) return false;
    for (std::size_t i = 0; i < prefix_.size(); ++i)
      if (words_[i] != prefix_[i] && words_[i] != former_prefix_[i]) return false;
    if (words_.back() != key && (former == nullptr || words_.back() != former)) return false;
    const std::string path = joined(prefix_, key);
    if (path != key_) note_spelling("--set ", key_, path);
    return true;
  }

  /// Keys of a similar spelling, or with the same last word in another group; the closest three.
  std::vector<std::string> near_matches(const std::vector<OptionEntry>& known) const {
    const auto last_word = [](const std::string& path) { return path.substr(path.rfind('.') + 1); };
    std::vector<std::pair<std::size_t, std::string>> candidates;
    for (const OptionEntry& entry : known) {
      if (entry.type == "group") continue;
      const std::size_t whole = edit_distance(entry.path, key_);
      const std::size_t word = edit_distance(last_word(entry.path), last_word(key_));
      const std::size_t score = std::min(whole, word + 1);
      if (score <= 3) candidates.emplace_back(score, entry.path);
    }
    std::ranges::stable_sort(candidates, {}, &std::pair<std::size_t, std::string>::first);
    std::vector<std::string> near;
    for (const auto& [score, path] : candidates) {
      if (near.size() < 3) near.push_back(path);
    }
    return near;
  }

  std::string assignment_, key_;
  std::vector<std::string> words_;  ///< words of the key, between its dots
  YAML::Node value_;
  std::vector<std::string> prefix_, former_prefix_;
  bool assigned_ = false, group_ = false;
};

OptionAssignment::OptionAssignment(const std::string& assignment)
    : setter_(std::make_unique<Setter>(assignment)) {}
OptionAssignment::~OptionAssignment() = default;
OptionVisitor& OptionAssignment::visitor() { return *setter_; }
void OptionAssignment::finish(const std::vector<OptionEntry>& known, const LogSink& log) {
  setter_->finish(known);
  if (log)
    for (const std::string& note : setter_->notes) log(LogLevel::kWarning, note);
}

}  // namespace internal
}  // namespace placegraph
