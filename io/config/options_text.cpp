#include <fmt/format.h>
#include <fmt/ranges.h>
#include <placegraph/graph/text/wrapped_text.h>
#include <placegraph/io/config/yaml_config.h>

#include <algorithm>
#include <cmath>

namespace placegraph {

namespace {

constexpr const char* kLevelNames[] = {"basic", "advanced", "internal"};

std::string describe_domain(const OptionEntry& entry) {
  if (!entry.choices.empty()) return fmt::format("{}", fmt::join(entry.choices, " | "));
  const bool below = std::isfinite(entry.range.min), above = std::isfinite(entry.range.max);
  if (below && above) return fmt::format("{} to {}", entry.range.min, entry.range.max);
  if (below) return fmt::format(">= {}", entry.range.min);
  if (above) return fmt::format("<= {}", entry.range.max);
  return {};
}

/// "- `key` = `value` (range; level): meaning".
std::string list_item(const OptionEntry& entry) {
  const std::string key = entry.path.substr(entry.path.rfind('.') + 1);
  const std::string domain = describe_domain(entry);
  return wrapped_text(
      fmt::format("- `{}` = `{}` ({}{}): {}", key, entry.value, domain.empty() ? "" : domain + "; ",
                  kLevelNames[static_cast<int>(entry.level)], entry.doc),
      "  ");
}

}  // namespace

std::string dump_options(const std::vector<OptionEntry>& entries) {
  std::string text;
  for (const OptionEntry& entry : entries) {
    const auto depth = static_cast<std::size_t>(std::ranges::count(entry.path, '.'));
    const std::string indent(2 * depth, ' ');
    const std::string key = entry.path.substr(entry.path.rfind('.') + 1);
    const std::string domain = describe_domain(entry);
    text += fmt::format("{}# {}{}\n", indent, entry.doc,
                        domain.empty() ? "" : fmt::format(" ({})", domain));
    text += entry.type == "group" ? fmt::format("{}{}:\n", indent, key)
                                  : fmt::format("{}{}: {}\n", indent, key, entry.value);
  }
  return text;
}

std::string options_markdown(const std::vector<OptionEntry>& entries) {
  std::string text, group;
  bool begins = true;  // the next item is the first of its list
  for (const OptionEntry& entry : entries) {
    if (entry.type == "group") {
      text += fmt::format("\n## `{}`\n\n{}\n", entry.path, entry.doc);
      group = entry.path + ".";
      begins = true;
      continue;
    }
    const std::string parent = entry.path.substr(0, entry.path.rfind('.') + 1);
    if (parent != group) {  // back from a nested group
      text += parent.empty()
                  ? std::string("\n## Further options\n")
                  : fmt::format("\n## `{}`, continued\n", parent.substr(0, parent.size() - 1));
      group = parent;
      begins = true;
    }
    if (begins) text += '\n';
    text += list_item(entry);
    begins = false;
  }
  return text;
}

}  // namespace placegraph
