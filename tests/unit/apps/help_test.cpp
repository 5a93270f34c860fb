#include "apps/help.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/apps/shell/small_command_line.h"

namespace placegraph::apps {
namespace help_test {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

TEST(ExampleFormatter, HelpBeginsWithTheExample) {
  SmallCommandLine line;
  line.app.formatter(std::make_shared<ExampleFormatter>());
  line.info->formatter(std::make_shared<ExampleFormatter>());
  const std::string help = line.info->help();
  EXPECT_THAT(help, StartsWith("Example: placegraph map info a.db\n\n"));
  EXPECT_EQ(help.find("placegraph map info a.db"), help.rfind("placegraph map info a.db"));
  EXPECT_THAT(help, AllOf(HasSubstr("--kind"), Not(HasSubstr("secret"))));
  line.info->footer("");
  EXPECT_THAT(line.info->help(), Not(HasSubstr("Example")));
}

TEST(ExampleFormatter, OfSubcommandsThereAreNoExamples) {
  SmallCommandLine line;
  const ExampleFormatter formatter;
  EXPECT_THAT(formatter.make_help(line.run, "run", CLI::AppFormatMode::Sub),
              Not(HasSubstr("Example")));
  EXPECT_THAT(formatter.make_help(line.run, "run", CLI::AppFormatMode::Normal),
              StartsWith("Example: placegraph run a\n\n"));
  EXPECT_EQ(formatter.make_footer(line.run), "");
}

// The options are made in every order, and so lie in memory in different ones.
TEST(ExampleFormatter, NeedsAndExcludesAreListedByName) {
  const ExampleFormatter formatter;
  std::vector<std::string> names = {"--alpha", "--beta", "--gamma"};
  do {
    CLI::App app;
    CLI::Option* asked = app.add_flag("--asked");
    std::vector<CLI::Option*> options;
    for (const std::string& name : names) options.push_back(app.add_flag(name));
    for (CLI::Option* option : options) asked->needs(option);
    asked->excludes(app.add_flag("--zeta"));
    asked->excludes(app.add_flag("--delta"));
    EXPECT_EQ(formatter.make_option_opts(asked),
              " Needs: --alpha --beta --gamma Excludes: --delta --zeta");
  } while (std::ranges::next_permutation(names).found);
}

TEST(ExampleFormatter, OtherNotesOnAnOptionStay) {
  SmallCommandLine line;
  const ExampleFormatter formatter;
  const CLI::Formatter standard;
  for (const char* name : {"MAP", "--kind", "--json"}) {
    const CLI::Option* option = line.info->get_option(name);
    EXPECT_EQ(formatter.make_option_opts(option), standard.make_option_opts(option)) << name;
  }
  EXPECT_THAT(formatter.make_option_opts(line.info->get_option("MAP")), HasSubstr("REQUIRED"));
}

}  // namespace help_test
}  // namespace placegraph::apps
