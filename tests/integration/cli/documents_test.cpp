// The commands that README.md and docs/ show are commands of this program, in their present
// spelling and with flags that they have. docs/first_run.md is also run, by page_commands.py.
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "apps/command_line.h"
#include "apps/shell/cmd_tree.h"
#include "apps/shell/spellings.h"
#include "tests/support/paths.h"

namespace placegraph {
namespace documents_test {

namespace fs = std::filesystem;

struct ShownCommand {
  std::string file;
  int line = 0;
  std::vector<std::string> words;  ///< behind "placegraph", up to a pipe, a comment or the next one
};

std::vector<std::string> documents() {
  std::vector<std::string> paths = {test::source_dir() + "/README.md"};
  for (const fs::directory_entry& entry :
       fs::recursive_directory_iterator(test::source_dir() + "/docs"))
    if (entry.path().extension() == ".md") paths.push_back(entry.path().string());
  std::ranges::sort(paths);
  return paths;
}

bool ends_command(const std::string& word) {
  return word.starts_with('#') || word == "|" || word == "&&" || word == ">" || word == "2>" ||
         word == ";" || word.ends_with(';');
}

/// Lines of code that begin with `placegraph`, in fences or indented by four, continued behind "\".
void add_commands(const std::string& path, std::vector<ShownCommand>& commands) {
  std::ifstream file(path);
  bool fenced = false;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    const int first = ++number;
    if (line.find("```") != line.npos && line.find_first_not_of(' ') == line.find("```"))
      fenced = !fenced;
    if (!fenced && !line.starts_with("    ")) continue;
    while (line.ends_with('\\')) {
      line.pop_back();
      std::string rest;
      if (!std::getline(file, rest)) break;
      ++number;
      line += " " + rest;
    }
    std::istringstream stream(line);
    const std::vector<std::string> words(std::istream_iterator<std::string>(stream), {});
    const auto program = std::ranges::find_if(words, [](const std::string& w) {
      return w == "placegraph" || w.ends_with("/placegraph");
    });
    if (program == words.end()) continue;
    const bool leads = std::all_of(words.begin(), program, [](const std::string& w) {
      return w == "$" || w.find('=') != w.npos;
    });
    if (!leads) continue;
    const auto end = std::find_if(program, words.end(), ends_command);
    commands.push_back({fs::path(path).filename().string(), first, {program + 1, end}});
  }
}

/// "--a" and "--b" of "[--a|--b=3]".
std::vector<std::string> flags_in(std::string word) {
  std::erase_if(word, [](char c) { return c == '[' || c == ']' || c == '(' || c == ')'; });
  std::vector<std::string> flags;
  std::istringstream stream(word);
  for (std::string piece; std::getline(stream, piece, '|');)
    if (piece.starts_with("--") && piece.size() > 2)
      flags.push_back(piece.substr(0, piece.find('=')));
  return flags;
}

TEST(Documents, ShowCommandsThatTheProgramHas) {
  const auto app = apps::make_command_line();
  std::vector<ShownCommand> shown;
  for (const std::string& path : documents()) add_commands(path, shown);
  EXPECT_GT(shown.size(), 100U);
  for (const ShownCommand& command : shown) {
    const std::string where = command.file + ":" + std::to_string(command.line);
    const apps::CommandWords present = apps::present_spelling(command.words);
    EXPECT_TRUE(present.notes.empty()) << where << ": " << present.notes.front();
    const CLI::App* at = app.get();
    auto word = present.words.begin();
    for (; word != present.words.end() && !apps::commands_of(*at).empty(); ++word) {
      const auto verbs = apps::commands_of(*at);
      const std::string name = word->substr(0, word->find('|'));  // "surfaces|labels": the first
      const auto found = std::ranges::find_if(
          verbs, [&](const CLI::App* verb) { return verb->get_name() == name; });
      if (found == verbs.end()) break;
      at = *found;
    }
    const bool placeholder =
        word != present.words.end() && (std::isupper((*word)[0]) || word->starts_with("--"));
    EXPECT_TRUE(apps::commands_of(*at).empty() || placeholder || word == present.words.end())
        << where << ": no command '" << *word << "'";
    for (; word != present.words.end(); ++word)
      for (const std::string& flag : flags_in(*word))
        EXPECT_NE(at->get_option_no_throw(flag), nullptr)
            << where << ": " << apps::full_name(*at) << " has no " << flag;
  }
}

}  // namespace documents_test
}  // namespace placegraph
