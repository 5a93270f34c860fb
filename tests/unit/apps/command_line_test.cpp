#include "apps/command_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "apps/shell/cmd_tree.h"
#include "apps/shell/spellings.h"

namespace placegraph::apps {
namespace command_line_test {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// What is said of words that end with an error or with help: no command is run.
class UnknownWords : public ::testing::Test {
 protected:
  void parse(std::vector<std::string> words) {
    app = make_command_line();
    std::ranges::reverse(words);
    EXPECT_THROW(app->parse(std::move(words)), CLI::Error);
  }
  std::string command_in(const std::vector<std::string>& words) {
    parse(words);
    return unknown_command(*app);
  }
  std::string word_in(const std::vector<std::string>& words) {
    parse(words);
    return unknown_words(*app);
  }

 private:
  std::unique_ptr<CLI::App> app;
};

TEST_F(UnknownWords, AreNoneInAGoodCommandLine) {
  for (const std::vector<std::string>& words : {std::vector<std::string>{},
                                                {"map"},
                                                {"--help"},
                                                {"map", "info", "a.db", "--help"},
                                                {"run", "s", "--out", "o", "--help"}}) {
    EXPECT_EQ(command_in(words), "") << testing::PrintToString(words);
    EXPECT_EQ(word_in(words), "") << testing::PrintToString(words);
  }
}

TEST(CommandLine, HasTheGroupsOfTheElementsBesideThoseOfTheCore) {
  const auto app = make_command_line();
  const auto commands = [&](const std::string& group) {
    std::vector<std::string> names;
    for (const CLI::App* command : commands_of(*app->get_subcommand(group)))
      names.push_back(command->get_name());
    return names;
  };
  EXPECT_THAT(commands("map"), ::testing::IsSupersetOf({"info", "label", "plan", "street"}));
  EXPECT_THAT(commands("eval"), ::testing::IsSupersetOf({"trajectory", "labels"}));
  for (const char* group : {"places", "image", "track", "flight", "train"})
    EXPECT_THAT(commands(group), ::testing::Not(::testing::IsEmpty())) << group;
}

TEST_F(UnknownWords, ACommandGetsSimilarOnesOfItsGroup) {
  EXPECT_EQ(command_in({"rnu"}), "no command 'rnu'; did you mean run?");
  EXPECT_EQ(command_in({"map", "inof", "x"}), "no command 'inof'; did you mean info?");
  EXPECT_EQ(command_in({"map", "optimize"}), "no command 'optimize'");  // of another group
  EXPECT_EQ(command_in({"optimise"}), "no command 'optimise'; did you mean optimize?");
  EXPECT_EQ(word_in({"map", "inof", "--no-such-flag"}), "no command 'inof'; did you mean info?");
}

TEST_F(UnknownWords, AFlagIsNoCommand) {
  EXPECT_EQ(command_in({"map", "--inof"}), "");
  EXPECT_EQ(command_in({"run", "a", "b"}), "");  // `run` has no commands
  EXPECT_THAT(word_in({"map", "info", "a.db", "--jsno=3", "more"}),
              AllOf(HasSubstr("no option '--jsno'"), HasSubstr("did you mean --json?")));
  EXPECT_EQ(word_in({"map", "info", "a.db", "-Q"}), "no option '-Q'");
}

TEST_F(UnknownWords, AnOptionOfARunIsSetByItsKey) {
  EXPECT_EQ(word_in({"run", "s", "--max-frames", "20"}),
            "no option '--max-frames'; `--set max_frames=...` sets it");
  EXPECT_EQ(word_in({"run", "s", "--first-training=9"}),
            "no option '--first-training'; `--set loops.database.first_training=...` sets it");
  EXPECT_EQ(word_in({"map", "info", "a.db", "--max-frames"}), "no option '--max-frames'");
}

TEST_F(UnknownWords, ASuperfluousWordIsNamed) {
  EXPECT_EQ(word_in({"map", "info", "a.db", "b.db", "c.db"}), "unexpected 'b.db'");
}

// Whoever types a short form gets a command that there is.
TEST(CommandLineTable, ShortFormsLeadToCommands) {
  const std::unique_ptr<CLI::App> app = make_command_line();
  for (const ShortForm& form : short_forms()) {
    const std::size_t blank = form.command.find(' ');
    ASSERT_NE(blank, std::string::npos) << form.command;
    const CLI::App* group = app->get_subcommand(form.command.substr(0, blank));
    EXPECT_EQ(full_name(*group->get_subcommand(form.command.substr(blank + 1))),
              "placegraph " + form.command);
    EXPECT_EQ(std::ranges::count(first_words(), form.name.substr(0, form.name.find(' '))), 1);
  }
}

TEST(CommandLineTable, EveryOldSpellingIsThatOfACommand) {
  const std::unique_ptr<CLI::App> app = make_command_line();
  for (const std::string& word : first_words()) {
    if (word == "help" || word == "version") continue;
    const std::vector<std::string> words = present_spelling({word, "argument"}).words;
    const CLI::App* command = app->get_subcommand(words.front());
    EXPECT_NE(command, nullptr) << word;
    if (word == "scene" || word == "map") continue;  // groups
    EXPECT_NE(command->get_subcommand(words.at(1)), nullptr) << word;
  }
}

}  // namespace command_line_test
}  // namespace placegraph::apps
