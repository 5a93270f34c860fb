#include "apps/shell/cmd_tree.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>

#include "apps/shell/command_reference.h"
#include "apps/shell/man_pages.h"
#include "tests/support/message_of.h"
#include "tests/unit/apps/shell/small_command_line.h"

namespace placegraph::apps {
namespace cmd_tree_test {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class SmallTree : public ::testing::Test {
 protected:
  SmallCommandLine line;
};

TEST_F(SmallTree, CommandsAreInTheirOrderWithoutHiddenOnes) {
  std::vector<std::string> names;
  for (const CLI::App* command : commands_of(line.app)) names.push_back(command->get_name());
  EXPECT_THAT(names, ElementsAre("map", "run"));
  EXPECT_THAT(commands_of(*line.app.get_subcommand("map")), ElementsAre(line.info, line.draw));
  EXPECT_THAT(commands_of(*line.run), ElementsAre());
}

TEST_F(SmallTree, TheParsedCommandIsTheInnermost) {
  EXPECT_EQ(&parsed_command(line.app), &line.app);
  line.parse({"run", "images"});
  EXPECT_EQ(&parsed_command(line.app), line.run);
  line.parse({"map", "info", "a.db"});
  EXPECT_EQ(&parsed_command(line.app), line.info);
  EXPECT_EQ(full_name(*line.info), "placegraph map info");
  EXPECT_EQ(full_name(line.app), "placegraph");
}

TEST_F(SmallTree, ArgumentsAndChoicesAreTold) {
  EXPECT_TRUE(is_argument(*line.info->get_option("MAP")));
  EXPECT_FALSE(is_argument(*line.info->get_option("--kind")));
  EXPECT_THAT(choices_of(*line.info->get_option("--kind")), ElementsAre("short", "long"));
  EXPECT_THAT(choices_of(*line.info->get_option("MAP")), ElementsAre());
  EXPECT_THAT(choices_of(*line.info->get_option("--json")), ElementsAre());
}

TEST_F(SmallTree, EveryShownCommandHasAManualPage) {
  std::vector<std::string> names;
  for (const ManPage& page : man_pages(line.app)) names.push_back(page.name);
  EXPECT_THAT(names, ElementsAre("placegraph.1", "placegraph-map.1", "placegraph-map-info.1",
                                 "placegraph-map-draw.1", "placegraph-run.1"));
}

TEST_F(SmallTree, AManualPageShowsWhatItsCommandTakes) {
  const std::vector<ManPage> pages = man_pages(line.app);
  const std::string &group = pages.at(1).text, &info = pages.at(2).text;
  EXPECT_THAT(group, AllOf(StartsWith(".TH PLACEGRAPH\\-MAP 1 "), HasSubstr("\n.I COMMAND\n"),
                           HasSubstr(".BR placegraph\\-map\\-draw (1)\nDraw a map\n")));
  EXPECT_THAT(info, HasSubstr(".B placegraph map info\n[\\fIOPTIONS\\fR] \\fIMAP\\fR\n"));
  EXPECT_THAT(info, HasSubstr(".SH ARGUMENTS\n.TP\n.B MAP\na file\n.SH OPTIONS\n"));
  EXPECT_THAT(info, HasSubstr(".B \\-k,\\-\\-kind \\fIVALUE\\fR\nkind of a|b (default: short)\n"));
  EXPECT_THAT(info, HasSubstr(".B \\-\\-json\nprint .json \\e nothing else\n"));
  EXPECT_THAT(info, AllOf(HasSubstr(".EX\nplacegraph map info a.db\n.EE\n"),
                          Not(HasSubstr("secret")), Not(HasSubstr("COMMANDS"))));
}

// Roff takes a line that begins with a dot or an apostrophe as a request.
TEST_F(SmallTree, NoTextOfAManualPageIsARequest) {
  line.draw->description(".so /etc/passwd");
  line.run->description("'quoted'");
  for (const ManPage& page : man_pages(line.app))
    EXPECT_THAT(page.text, AllOf(Not(HasSubstr("\n.so")), Not(HasSubstr("\n'quoted"))));
  EXPECT_THAT(man_pages(line.app)[1].text, HasSubstr("\n\\&.so /etc/passwd\n"));
}

TEST_F(SmallTree, TheReferenceHasASectionForEveryCommand) {
  const std::string text = command_reference(line.app);
  const std::size_t sections = text.find("## One by one");
  ASSERT_NE(sections, std::string::npos);
  const std::string list = text.substr(0, sections), details = text.substr(sections);
  EXPECT_THAT(list, HasSubstr("\n- `run SEQUENCE`: Run\n"));
  EXPECT_THAT(list, HasSubstr("\n**map**: Saved maps\n\n- `map info MAP`: Tell what a map "
                              "\\<holds>, it's \\*all\\*\n- `map draw`: Draw a map\n"));
  EXPECT_LT(details.find("### `map info MAP`"), details.find("### `map draw`"));
  EXPECT_THAT(details, HasSubstr("\n- `-k,--kind VALUE`: kind of a\\|b; one of short, long "
                                 "(default: `short`)\n- `--json`: "));
  EXPECT_THAT(details, HasSubstr("See [map](map.md)."));
  EXPECT_THAT(details, HasSubstr("\n```sh\nplacegraph map draw a.db\n```\n"));
  EXPECT_THAT(text, AllOf(Not(HasSubstr("secret")), Not(HasSubstr("hidden"))));
  line.app.add_subcommand("juggle", "Juggle");
  EXPECT_EQ(test::message_of<ArgumentError>([&] { (void)command_reference(line.app); }),
            "command_reference: no page for juggle");
}

}  // namespace cmd_tree_test
}  // namespace placegraph::apps
