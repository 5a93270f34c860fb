// The table of all commands: names, descriptions, flags with one meaning and one unit, completion
// and manual pages made from it.
#include "apps/command_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>

#include <CLI/CLI.hpp>
#include <functional>
#include <map>
#include <regex>
#include <set>

#include "apps/shell/cmd_tree.h"
#include "apps/shell/command_reference.h"
#include "apps/shell/completion.h"
#include "apps/shell/man_pages.h"
#include "apps/shell/path_options.h"
#include "apps/shell/spellings.h"
#include "tests/support/cli_test.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace command_line_test {

using apps::commands_of;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

void for_each_command(const CLI::App& app, const std::function<void(const CLI::App&)>& visit) {
  for (const CLI::App* command : commands_of(app)) {
    visit(*command);
    for_each_command(*command, visit);
  }
}

/// "[px]" of a description, or "".
std::string unit_of(const std::string& text) {
  std::smatch match;
  return std::regex_search(text, match, std::regex("\\[([a-z0-9/^]+)\\]")) ? match[1].str() : "";
}

class CommandLine : public testing::Test {
 protected:
  std::unique_ptr<CLI::App> app = apps::make_command_line();
};

TEST_F(CommandLine, HasTenGroupsAndASmallNumberOfCommandsBesideThem) {
  std::vector<std::string> groups, others;
  for (const CLI::App* command : commands_of(*app))
    (commands_of(*command).empty() ? others : groups).push_back(command->get_name());
  EXPECT_THAT(groups, ElementsAre("map", "eval", "graph", "places", "image", "track", "flight",
                                  "synth", "train"));
  EXPECT_THAT(others, ElementsAre("run", "inspect", "report", "view", "config", "completion",
                                  "help", "version", "man"));
}

TEST_F(CommandLine, EveryCommandHasADescriptionAndAnExampleOfItself) {
  for_each_command(*app, [](const CLI::App& command) {
    const std::string name = apps::full_name(command);
    EXPECT_FALSE(command.get_description().empty()) << name;
    EXPECT_THAT(command.get_footer(), StartsWith(name)) << name;
  });
}

TEST_F(CommandLine, EveryFlagHasADescription) {
  for_each_command(*app, [](const CLI::App& command) {
    for (const CLI::Option* option : command.get_options())
      EXPECT_GT(option->get_description().size(), 3U)
          << apps::full_name(command) << " " << option->get_name();
  });
}

TEST_F(CommandLine, AFlagHasOneUnitAndTakesAValueOrNotWhereverItIs) {
  std::map<std::string, std::map<std::string, std::string>> units, arities;
  for_each_command(*app, [&](const CLI::App& command) {
    for (const CLI::Option* option : command.get_options())
      for (const std::string& name : option->get_lnames()) {
        units[name][unit_of(option->get_description())] = apps::full_name(command);
        arities[name][option->get_items_expected_max() > 0 ? "value" : "flag"] =
            apps::full_name(command);
      }
  });
  units.erase("out");      // formats of files
  arities.erase("draw");   // a folder for a sequence, nothing where NAME.drawn.png is its name
  arities.erase("calib");  // of `track plane` the value may be left out
  for (const auto& [name, found] : units)
    EXPECT_EQ(found.size(), 1U) << "--" << name << " in " << found.begin()->second << " and "
                                << found.rbegin()->second;
  for (const auto& [name, found] : arities)
    EXPECT_EQ(found.size(), 1U) << "--" << name << " in " << found.begin()->second << " and "
                                << found.rbegin()->second;
}

TEST_F(CommandLine, WordsThatManyCommandsShareHaveOneDescription) {
  const std::set<std::string> shared = {"config",  "csv",     "force", "json",         "plot",
                                        "profile", "range",   "seed",  "sensor",       "sequence",
                                        "set",     "threads", "times", "camera-height"};
  std::map<std::string, std::set<std::string>> meanings;
  for_each_command(*app, [&](const CLI::App& command) {
    for (const CLI::Option* option : command.get_options())
      for (const std::string& name : option->get_lnames())
        if (shared.contains(name)) meanings[name].insert(option->get_description());
  });
  EXPECT_EQ(meanings.size(), shared.size());
  for (const auto& [name, found] : meanings)
    EXPECT_EQ(found.size(), 1U) << "--" << name << ": " << testing::PrintToString(found);
}

TEST_F(CommandLine, TheOutputIsNamedByOneFlagInBothSpellings) {
  for_each_command(*app, [](const CLI::App& command) {
    for (const CLI::Option* option : command.get_options()) {
      const auto& names = option->get_lnames();
      if (std::find(names.begin(), names.end(), "out") == names.end()) continue;
      EXPECT_THAT(option->get_snames(), ElementsAre("o")) << apps::full_name(command);
    }
  });
}

TEST_F(CommandLine, CompletionKnowsCommandsFlagsAndChoices) {
  for (const std::string& shell : apps::completion_shells()) {
    const std::string script = apps::completion_script(*app, shell);
    for (const char* word : {"vanishing", "camera-height", "stereo", "georeference"})
      EXPECT_THAT(script, HasSubstr(word)) << shell;
  }
  EXPECT_THROW(apps::completion_script(*app, "tcsh"), ArgumentError);
}

TEST_F(CommandLine, ThereIsAManualPageForEveryCommand) {
  std::set<std::string> names;
  for (const apps::ManPage& page : apps::man_pages(*app)) {
    names.insert(page.name);
    EXPECT_THAT(page.text, AllOf(StartsWith(".TH "), HasSubstr(".SH EXAMPLE"))) << page.name;
  }
  for_each_command(*app, [&](const CLI::App& command) {
    std::string name = apps::full_name(command);
    std::replace(name.begin(), name.end(), ' ', '-');
    EXPECT_TRUE(names.contains(name + ".1")) << name;
  });
}

TEST_F(CommandLine, TheReferenceOfCommandsIsTheOneThatTheProgramWrites) {
  EXPECT_EQ(test::read_file(test::source_dir() + "/docs/commands.md"),
            apps::command_reference(*app))
      << "run `placegraph man docs --markdown`";
}

TEST_F(CommandLine, ChoicesOfCompletionArePlainWords) {
  for (const std::string& shell : apps::completion_shells())
    EXPECT_THAT(apps::completion_script(*app, shell), testing::Not(HasSubstr("->"))) << shell;
}

TEST_F(CommandLine, CommandsOfTheGroupsThatWereCommandsAreKnownAsSuch) {
  for (const std::string group : {"eval", "synth"})
    for (const CLI::App* command : commands_of(*app->get_subcommand(group)))
      EXPECT_THAT(apps::present_spelling({group, command->get_name(), "x"}).words,
                  ElementsAre(group, command->get_name(), "x"));
}

/// All commands, at any depth.
std::vector<CLI::App*> all_commands(CLI::App& app) {
  std::vector<CLI::App*> commands;
  for (CLI::App* command : app.get_subcommands([](CLI::App*) { return true; })) {
    commands.push_back(command);
    for (CLI::App* below : all_commands(*command)) commands.push_back(below);
  }
  return commands;
}

// What is neither of these words, nor a number or a choice, says what the command does with it: it
// is a kOutput or a kInput, or checked to exist.
TEST_F(CommandLine, EveryTextIsAnOutputAnInputOrAWord) {
  const std::set<std::string> words = {
      "--align-frames", "--align-seconds", "--apply", "--apply-truth", "--below", "--delta",
      "--figures",
      "--name",      "--sequences",    "--split",     "--system",
      "--blind",     "--clock-offset", "--cues",      "--defects", "--dictionary",  "--difficulty",
      "--elements",  "--gravity",      "--holdout",   "--normal",  "--lever-arm",   "--origin",
      "--recognizer", "--scene",     "--set",          "--size",      "--systems", "--truth-noise", "--truth-same",
      "--title",     "PAIR",           "WORLD"};
  std::set<std::string> found;
  for (const CLI::App* command : all_commands(*app))
    for (const CLI::Option* option : command->get_options()) {
      EXPECT_FALSE(apps::is_output(*option) && apps::is_input(*option)) << option->get_name();
      if (!option->get_type_name().starts_with("TEXT") || option->get_items_expected_max() == 0 ||
          !apps::choices_of(*option).empty() || apps::is_input(*option))
        continue;
      found.insert(option->get_lnames().empty() ? option->get_name()
                                                : "--" + option->get_lnames().front());
    }
  EXPECT_EQ(found, words);
}

// With one file for an output and for any other path of the command, nothing is begun.
TEST_F(CommandLine, NoOutputMayBeAnotherOutputOrAnInput) {
  const test::TemporaryFolder folder;
  const std::string file = folder.write("a", ""), again = folder.path() + "/./a";
  int pairs = 0;
  for (CLI::App* command : all_commands(*app)) {
    const std::vector<CLI::Option*> options = command->get_options();
    for (CLI::Option* output : options)
      for (CLI::Option* other : options) {
        const bool path = apps::is_output(*other) || apps::is_input(*other);
        if (!apps::is_output(*output) || !path || output == other) continue;
        output->add_result(file);
        other->add_result(again);
        const std::string message =
            test::message_of<ArgumentError>([&] { apps::require_distinct_paths(*command); });
        EXPECT_THAT(message, AllOf(HasSubstr(output->get_name()), HasSubstr(other->get_name())))
            << apps::full_name(*command);
        output->clear();
        other->clear();
        ++pairs;
      }
  }
  EXPECT_GT(pairs, 300);
}

class Outputs : public test::CliTest {};

TEST_F(Outputs, ThatAreOneFileAreRefusedBeforeTheWork) {
  test::write_file(dir / "a.txt", "0 0 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n2 2 1 0 0 0 0 1\n");
  std::filesystem::create_symlink("o", dir / "link");
  expect_usage_error("eval trajectory a.txt a.txt --csv o --latex ./o",
                     "--latex: ./o is where another output is to be written, that of --csv");
  expect_usage_error("eval a.txt a.txt --csv o --latex link", "that of --csv");
  expect_usage_error("eval a.txt a.txt --csv a.txt --force", "--csv: a.txt is an input");
  expect_usage_error("eval a.txt a.txt --plot e.png --plot-kind xyz,rpe --csv e_rpe.png",
                     "--plot: e_rpe.png is where another output is to be written, that of --csv");
  expect_usage_error("graph convert a.txt sub/../a.txt --force", "OUT: sub/../a.txt is an input");
  EXPECT_FALSE(std::filesystem::exists(dir / "o"));
}

class Misspelled : public test::CliTest {};

TEST_F(Misspelled, CommandsFlagsAndKeysGetSuggestions) {
  expect_usage_error("rnu", "no command 'rnu'; did you mean run? (see placegraph --help)");
  expect_usage_error("optimze g.g2o", "no command 'optimze'; did you mean optimize?");
  expect_usage_error("help rnu", "no command 'rnu'; did you mean run?");
  expect_usage_error("image cloud --help", "no command 'cloud'");
  expect_usage_error("map inof x",
                     "no command 'inof'; did you mean info? (see placegraph map --help)");
  expect_usage_error(
      "run s --out o --camera_height 1.65",
      "no option '--camera_height'; did you mean --camera-height? (see placegraph run "
      "--help)");
  expect_usage_error("run s --max-frames 20 --out o",
                     "no option '--max-frames'; `--set max_frames=...` sets it");
  expect_usage_error("map export m --obj a.obj", "(see placegraph map export --help)");
  test::write_file(dir / "c.yaml", "loops:\n  enabeld: true\n");
  expect_usage_error("config --config c.yaml",
                     "c.yaml:2: loops.enabeld: unknown key; did you mean enabled?");
  expect_usage_error("run s --out o --config kitty_mono", "did you mean kitti_mono?");
}

TEST_F(Misspelled, BashCompletesByTheScript) {
  const auto completed = [&](const std::string& words, int at) {
    test::write_file(dir / "c.sh", "source ./script\nCOMP_WORDS=(" + words +
                                       ")\nCOMP_CWORD=" + std::to_string(at) +
                                       "\n_placegraph_words\necho \"${COMPREPLY[*]}\"\n");
    const std::string command = "cd '" + dir.path() + "' && bash c.sh > completed";
    EXPECT_EQ(std::system(command.c_str()), 0);
    return test::read_file(dir / "completed");
  };
  test::write_file(dir / "script", run("completion bash").out);
  EXPECT_EQ(completed("placegraph ma", 1), "map man match\n");
  EXPECT_EQ(completed("placegraph map exp", 2), "export explain\n");
  EXPECT_EQ(completed("placegraph run --sensor st", 3), "stereo\n");
  EXPECT_EQ(completed("placegraph run s --camera", 3), "--camera-height\n");
  EXPECT_EQ(completed("placegraph optimize --eng", 2), "--engine\n");
  EXPECT_EQ(completed("placegraph eval loops --format i", 4), "ibow\n");
  EXPECT_EQ(completed("placegraph run s", 2), "\n");  // bash completes a file
}

}  // namespace command_line_test
}  // namespace placegraph
