#include "apps/shell/spellings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <string_view>

namespace placegraph::apps {
namespace {

using Words = std::vector<std::string>;

struct CommandSpelling {
  Words given, present;
  bool short_form = false;  ///< stays, and is used without a note
};

/// Longer forms come before their beginnings.
const std::vector<CommandSpelling>& command_spellings() {
  static const std::vector<CommandSpelling> spellings = {
      {{"loops"}, {"eval", "loops"}, true},
      {{"match"}, {"places", "match"}, true},
      {{"optimize"}, {"graph", "optimize"}, true},
      {{"planes", "two-view"}, {"image", "two-view-planes"}},
      {{"planes"}, {"image", "planes"}, true},
      {{"vanishing"}, {"image", "vanishing"}, true},
      {{"bundle"}, {"graph", "bundle"}},
      {{"convert"}, {"graph", "convert"}},
      {{"eval-edges"}, {"eval", "edges"}},
      {{"explain"}, {"map", "explain"}},
      {{"flow"}, {"image", "flow"}},
      {{"georeference"}, {"map", "georeference"}},
      {{"hover"}, {"flight", "run"}},
      {{"lines", "detect"}, {"image", "lines"}},
      {{"lines", "match"}, {"image", "match-lines"}},
      {{"lines", "track"}, {"track", "lines"}},
      {{"lines"}, {"image", "lines"}},
      {{"localize"}, {"map", "localize"}},
      {{"map", "semantic"}, {"map", "street"}},
      {{"markers", "detect"}, {"image", "markers"}},
      {{"markers"}, {"image", "markers"}},
      {{"motion"}, {"image", "motion"}},
      {{"route"}, {"map", "route"}},
      {{"scene", "check"}, {"eval", "labels"}},
      {{"scene", "label"}, {"image", "labels"}},
      {{"scene", "orientation"}, {"image", "orientation"}},
      {{"scene", "popup"}, {"image", "popup"}},
      {{"scene", "surfaces"}, {"image", "surfaces"}},
      {{"scene"}, {"image"}},
      {{"synth-graph"}, {"synth", "graph"}},
      {{"track-plane"}, {"track", "plane"}},
      {{"vocabulary", "info"}, {"places", "vocabulary"}},
      {{"vocabulary", "train"}, {"train", "vocabulary"}},
      {{"vocabulary"}, {"train", "vocabulary"}},
  };
  return spellings;
}

/// A command that became a group, and the command of the group that it was.
struct GroupSpelling {
  std::string group, command;
  Words commands;           ///< of the group
  bool short_form = false;  ///< stays, and is used without a note
};

const std::vector<GroupSpelling>& group_spellings() {
  static const std::vector<GroupSpelling> spellings = {
      {"eval",
       "trajectory",
       {"trajectory", "table", "kitti", "info", "record", "gate", "edges", "loops", "labels",
        "noise"},
       true},
      {"synth", "sequence", {"sequence", "graph"}},
  };
  return spellings;
}

struct FlagSpelling {
  Words command;
  std::string given, present;
};

const std::vector<FlagSpelling>& flag_spellings() {
  static const std::vector<FlagSpelling> spellings = {
      {{"config"}, "--dump", "--all"},
      {{"eval", "loops"}, "--gt", "--truth"},
      {{"eval", "loops"}, "--log", "--csv"},
      {{"eval", "loops"}, "--names", "--systems"},
      {{"eval", "loops"}, "--poses", "--true-poses"},
      {{"flight", "run"}, "--true-markers", "--truth-markers"},
      {{"graph", "optimize"}, "--start", "--initialization"},
      {{"image", "flow"}, "--cues", "--flow-cues"},
      {{"image", "flow"}, "--turn", "--rotation"},
      {{"image", "flow"}, "--turn-sigma", "--rotation-sigma"},
      {{"image", "markers"}, "--camera", "--calib"},
      {{"image", "motion"}, "--model", "--method"},
      {{"image", "motion"}, "--noise", "--point-noise"},
      {{"image", "planes"}, "--gt", "--truth"},
      {{"image", "planes"}, "--gt-min-points", "--truth-min-points"},
      {{"image", "planes"}, "--gt-none", "--truth-none"},
      {{"image", "planes"}, "--gt-same", "--truth-same"},
      {{"image", "popup"}, "--level", "--level-camera"},
      {{"image", "popup"}, "--surfaces", "--surface-labels"},
      {{"image", "two-view-planes"}, "--calibration", "--calib"},
      {{"places", "classify"}, "--cues", "--appearance"},
      {{"places", "match"}, "--cues", "--appearance"},
      {{"track", "plane"}, "--model", "--motion-model"},
  };
  return spellings;
}

bool begins_with(const Words& words, const Words& head) {
  return words.size() >= head.size() && std::equal(head.begin(), head.end(), words.begin());
}

std::string note_of_old(const std::string& given, const std::string& present) {
  return fmt::format("'{}' is an old spelling of '{}'", given, present);
}

std::string joined(const Words& words) { return fmt::format("{}", fmt::join(words, " ")); }

void replace_head(Words& words, std::size_t length, const Words& head) {
  words.erase(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(length));
  words.insert(words.begin(), head.begin(), head.end());
}

/// `help map info` -> `map info --help`; `version` -> `--version`.
void replace_help(Words& words) {
  if (words.empty()) return;
  if (words.front() == "version") words.front() = "--version";
  if (words.front() != "help") return;
  words.erase(words.begin());
  words.emplace_back("--help");
}

void replace_command(CommandWords& line) {
  for (const CommandSpelling& spelling : command_spellings()) {
    if (!begins_with(line.words, spelling.given)) continue;
    if (!spelling.short_form)
      line.notes.push_back(note_of_old(joined(spelling.given), joined(spelling.present)));
    return replace_head(line.words, spelling.given.size(), spelling.present);
  }
  for (const GroupSpelling& spelling : group_spellings()) {
    if (line.words.size() < 2 || line.words.front() != spelling.group) continue;
    const auto is_argument = [](const std::string& word) { return !word.starts_with("-"); };
    const bool has_argument = std::any_of(line.words.begin() + 1, line.words.end(), is_argument);
    if (!has_argument || std::ranges::count(spelling.commands, line.words[1]) > 0) return;
    if (!spelling.short_form)
      line.notes.push_back(note_of_old(spelling.group, spelling.group + " " + spelling.command));
    return replace_head(line.words, 1, {spelling.group, spelling.command});
  }
}

void replace_flags(CommandWords& line) {
  for (const FlagSpelling& spelling : flag_spellings()) {
    if (!begins_with(line.words, spelling.command)) continue;
    for (std::string& word : line.words) {
      if (word != spelling.given && !word.starts_with(spelling.given + "=")) continue;
      word = spelling.present + word.substr(spelling.given.size());
      line.notes.push_back(note_of_old(spelling.given, spelling.present));
    }
  }
}

}  // namespace

std::vector<ShortForm> short_forms() {
  std::vector<ShortForm> forms;
  for (const CommandSpelling& spelling : command_spellings())
    if (spelling.short_form) forms.push_back({joined(spelling.given), joined(spelling.present)});
  return forms;
}

std::vector<std::string> first_words() {
  std::vector<std::string> words = {"help", "version"};
  for (const CommandSpelling& spelling : command_spellings())
    if (std::ranges::count(words, spelling.given.front()) == 0)
      words.push_back(spelling.given.front());
  return words;
}

CommandWords present_spelling(std::vector<std::string> words) {
  CommandWords line{std::move(words), {}};
  replace_help(line.words);
  replace_command(line);
  replace_flags(line);
  return line;
}

}  // namespace placegraph::apps
