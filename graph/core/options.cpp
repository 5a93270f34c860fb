#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/options.h>

#include <charconv>
#include <cmath>
#include <utility>

namespace placegraph {

void OptionVisitor::retired(const std::vector<RetiredOption>&, const char*) {}

namespace internal {
namespace {

/// The shortest text that reads back as the same number, in YAML's spelling.
std::string to_text(double value) {
  if (std::isnan(value)) return ".nan";
  if (std::isinf(value)) return value < 0 ? "-.inf" : ".inf";
  char buffer[32];
  const auto result = std::to_chars(buffer, buffer + sizeof(buffer), value);
  return std::string(buffer, result.ptr);
}

std::string to_text(const std::vector<double>& values) {
  std::string text = "[";
  for (const double value : values) text += (text.size() > 1 ? ", " : "") + to_text(value);
  return text + "]";
}

/// In double quotes unless it is a plain word that YAML cannot take for anything else.
std::string quoted(const std::string& value) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-' || c == '/' || c == '.';
  };
  bool is_plain = !value.empty() && ((value[0] >= 'a' && value[0] <= 'z') || value[0] == '/') &&
                  value != "true" && value != "false" && value != "null" && value != "yes" &&
                  value != "no" && value != "on" && value != "off" && value != "y" && value != "n";
  for (const char c : value) is_plain = is_plain && plain(c);
  if (is_plain) return value;
  std::string text = "\"";
  for (const char c : value) {
    if (c == '"' || c == '\\') text += '\\';
    if (c == '\n')
      text += "\\n";
    else if (c == '\t')
      text += "\\t";
    else
      text += c;
  }
  return text + "\"";
}

std::string join(const std::vector<std::string>& prefix, const char* key) {
  std::string path;
  for (const std::string& group : prefix) path += group + ".";
  return path + key;
}

}  // namespace

void OptionCollector::operator()(const char* key, bool& value, const char* doc) {
  add(key, value ? "true" : "false", doc, "bool");
}

void OptionCollector::operator()(const char* key, int& value, const char* doc, Range range) {
  check_range(key, value, range);
  add(key, std::to_string(value), doc, "int", range);
}

void OptionCollector::operator()(const char* key, std::uint64_t& value, const char* doc) {
  add(key, std::to_string(value), doc, "uint");
}

void OptionCollector::operator()(const char* key, double& value, const char* doc, Range range) {
  check_range(key, value, range);
  add(key, to_text(value), doc, "double", range);
}

void OptionCollector::operator()(const char* key, std::string& value, const char* doc) {
  add(key, quoted(value), doc, "string");
}

void OptionCollector::operator()(const char* key, std::vector<double>& value, const char* doc,
                                 Range range) {
  for (const double element : value) check_range(key, element, range);
  add(key, to_text(value), doc, "list", range);
}

void OptionCollector::choice_index(const char* key, int& index,
                                   const std::vector<std::string>& names, const char* doc) {
  const bool known = index >= 0 && index < static_cast<int>(names.size());
  if (check_ && !known)
    throw ArgumentError(join(prefix_, key) + ": " + std::to_string(index) + " is no choice of " +
                        std::to_string(names.size()));
  add(key, known ? names[index] : std::to_string(index), doc, "choice", {}, names);
}

void OptionCollector::retired(const std::vector<RetiredOption>& keys, const char* group) {
  for (const RetiredOption& each : keys) {
    const std::string key = group == nullptr ? each.key : std::string(group) + "." + each.key;
    OptionEntry& entry = retired_entries.emplace_back();
    entry.path = join(prefix_, key.c_str());
    entry.value = to_text(each.value);
    entry.type = "double";
  }
}

void OptionCollector::begin_group(const char* key, const char* doc) {
  add(key, "", doc, "group");
  levels_.push_back(entries.back().level);
  const std::string former = entries.back().former_path;
  prefix_.push_back(key);
  former_prefix_.push_back(former.empty() ? key : former.substr(former.rfind('.') + 1));
}

void OptionCollector::end_group() {
  levels_.pop_back();
  prefix_.pop_back();
  former_prefix_.pop_back();
}

void OptionCollector::check_group(const std::function<void()>& check) {
  try {
    check();
  } catch (const ArgumentError& error) {
    throw ArgumentError(join(prefix_, error.what()));
  }
}

void OptionCollector::add(const char* key, std::string value, const char* doc, const char* type,
                          Range range, std::vector<std::string> choices) {
  const Marks marks = take_marks();
  const std::string path = join(prefix_, key);
  const std::string former =
      join(former_prefix_, marks.former_key != nullptr ? marks.former_key : key);
  entries.push_back({path, std::move(value), doc, type, range, std::move(choices),
                     marks.level.value_or(levels_.back()), former == path ? "" : former});
}

void OptionCollector::check_range(const char* key, double value, Range range) const {
  if (!check_ || (value >= range.min && value <= range.max)) return;
  throw ArgumentError(join(prefix_, key) + ": " + to_text(value) + " outside [" +
                      to_text(range.min) + ", " + to_text(range.max) + "]");
}

}  // namespace internal
}  // namespace placegraph
