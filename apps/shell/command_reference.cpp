#include "apps/shell/command_reference.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/text/wrapped_text.h>

#include <CLI/CLI.hpp>
#include <string_view>
#include <utility>

#include "apps/shell/cmd_tree.h"
#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

/// Commands, or groups of them, and the page of docs/ that explains them; the first one that fits.
constexpr std::pair<std::string_view, std::string_view> kPages[] = {
    {"run", "first_run.md"},
    {"inspect", "datasets.md"},
    {"report", "report.md"},
    {"view", "viewer.md"},
    {"config", "options.md"},
    {"eval labels", "scene.md"},
    {"eval loops", "evaluation.md#loops"},
    {"eval table", "evaluation.md#tables"},
    {"eval edges", "evaluation.md#edges"},
    {"eval info", "evaluation.md#a-trajectory-without-truth"},
    {"eval kitti", "evaluation.md#kittis-benchmark"},
    {"eval noise", "evaluation.md#noise-of-the-truth"},
    {"eval record", "evaluation.md#is-this-change-a-regression"},
    {"eval gate", "evaluation.md#is-this-change-a-regression"},
    {"eval", "evaluation.md"},
    {"map loops", "map.md#editing-loops"},
    {"map plan", "floor_plan.md"},
    {"map street", "street_map.md"},
    {"map georeference", "georeference.md"},
    {"map export", "exports.md"},
    {"map import", "exports.md#models-of-colmap-as-maps"},
    {"map label", "map.md#labels"},
    {"map localize", "map.md#placing-images"},
    {"map explain", "map.md#one-frame"},
    {"map", "map.md"},
    {"graph convert", "datasets.md#trajectory-files"},
    {"graph", "optimize.md"},
    {"places vocabulary", "place_recognition.md#visual-words"},
    {"places classify", "place_recognition.md#labelled-places"},
    {"places", "place_recognition.md"},
    {"image flow", "flow.md"},
    {"image motion", "motion.md"},
    {"image lines", "cues.md#lines"},
    {"image match-lines", "cues.md#lines"},
    {"image vanishing", "cues.md#manhattan-frames"},
    {"image planes", "planes.md"},
    {"image two-view-planes", "planes.md"},
    {"image markers", "markers.md"},
    {"image orientation", "floor_plan.md"},
    {"image popup", "scene.md#a-mesh-of-one-image"},
    {"image", "scene.md"},
    {"track lines", "cues.md#lines"},
    {"track plane", "track_plane.md"},
    {"flight", "flight.md"},
    {"synth graph", "optimize.md#graphs-to-practise-on"},
    {"synth", "synthetic_world.md"},
    {"train planarity", "planes.md#the-planarity-model"},
    {"train environment", "scene.md#kinds-of-environments"},
    {"train vocabulary", "place_recognition.md#visual-words"},
    {"train", "scene.md#training"},
    {"completion", ""},
    {"help", ""},
    {"version", ""},
    {"man", ""}};

const std::string kIntroduction =
    "Written by `placegraph man docs --markdown` from the definitions that `--help` prints. "
    "`placegraph GROUP VERB ...`; `placegraph help GROUP VERB` prints one entry of this page. "
    "`--quiet`, `--verbose` and `--debug` choose how much `run` says on stderr. "
    "Exit codes: " +
    std::string(kExitCodesText) +
    ". Short forms: `eval` (`eval trajectory`), `loops` (`eval loops`), "
    "`optimize` (`graph optimize`), `match` (`places match`), `planes` (`image planes`), "
    "`vanishing` (`image vanishing`). Earlier names still work and print one line with the name "
    "used here.";

/// The words behind "placegraph".
std::string words_of(const CLI::App& command) {
  return full_name(command).substr(std::string_view("placegraph ").size());
}

std::string_view page_of(const std::string& words) {
  for (const auto& [name, page] : kPages)
    if (words == name || words.starts_with(std::string(name) + " ")) return page;
  throw ArgumentError("command_reference: no page for " + words);
}

/// "image motion MATCHES".
std::string usage_of(const CLI::App& command) {
  std::string text = words_of(command);
  for (const CLI::Option* option : command.get_options())
    if (is_argument(*option)) text += " " + option->get_name(true);
  return text;
}

/// Characters that Markdown or a table would read as its own.
std::string markdown(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '|' || c == '<' || c == '*') out += '\\';
    out += c;
  }
  return out;
}

std::string option_item(const CLI::Option& option) {
  std::string name = option.get_name(is_argument(option), true);
  if (option.get_items_expected_max() > 0 && option.nonpositional()) name += " VALUE";
  std::string text = fmt::format("- `{}`: {}", name, markdown(option.get_description()));
  if (const std::vector<std::string> choices = choices_of(option); !choices.empty())
    text += fmt::format("; one of {}", fmt::join(choices, ", "));
  if (const std::string standard = option.get_default_str(); !standard.empty())
    text += fmt::format(" (default: `{}`)", standard);
  return wrapped_text(text, "  ");
}

std::string section_of(const CLI::App& command) {
  const std::string words = words_of(command);
  std::string text = fmt::format("\n### `{}`\n\n", usage_of(command));
  const std::string_view page = page_of(words);
  text += wrapped_text(
      markdown(command.get_description()) + "." +
          (page.empty() ? "" : fmt::format(" See [{}]({}).", page.substr(0, page.find('.')), page)),
      "");
  text += fmt::format("\n```sh\n{}\n```\n\n", command.get_footer());
  for (const CLI::Option* option : command.get_options())
    if (!option->get_group().empty() && option != command.get_help_ptr())
      text += option_item(*option);
  return text;
}

std::string list_item(const CLI::App& command) {
  return wrapped_text(
      fmt::format("- `{}`: {}", usage_of(command), markdown(command.get_description())), "  ");
}

}  // namespace

std::string command_reference(const CLI::App& app) {
  std::string general, list, sections;
  for (const CLI::App* command : commands_of(app)) {
    const auto verbs = commands_of(*command);
    if (verbs.empty()) {
      general += list_item(*command);
      sections += section_of(*command);
      continue;
    }
    list +=
        fmt::format("\n**{}**: {}\n\n", command->get_name(), markdown(command->get_description()));
    for (const CLI::App* verb : verbs) {
      list += list_item(*verb);
      sections += section_of(*verb);
    }
  }
  return "# Commands\n\n" + wrapped_text(kIntroduction, "") + "\n## All in one line each\n\n" +
         general + list + "\n## One by one\n" + sections;
}

}  // namespace placegraph::apps
