#include "apps/config/config.h"

#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/config/yaml_config.h>
#include <placegraph/pipeline/run.h>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph::apps {
namespace config_test {

using test::message_of;
using testing::HasSubstr;
using testing::MatchesRegex;

TEST(ConfigCommand, WritesYamlThatReadsBackAsTheOptionsItStandsFor) {
  const test::TemporaryFolder folder;
  ConfigArguments arguments;
  arguments.level = OptionLevel::kInternal;
  arguments.settings = {"seed=11", "max_frames=13"};
  arguments.out = folder / "my.yaml";
  const std::string text = config(arguments);
  EXPECT_EQ(test::read_file(arguments.out), text);
  RunOptions options;
  read_options(arguments.out, options);
  EXPECT_EQ(options.slam.seed, 11u);
  EXPECT_EQ(options.max_frames, 13);

  ConfigArguments again;
  again.level = OptionLevel::kInternal;
  again.config = arguments.out;
  EXPECT_EQ(config(again), text);
}

TEST(ConfigCommand, PrintsTheBasicOptionsUnlessMoreIsAskedFor) {
  ConfigArguments arguments;
  const auto lines = [&](OptionLevel level) {
    arguments.level = level;
    const std::string text = config(arguments);
    return std::count(text.begin(), text.end(), '\n');
  };
  const auto basic = lines(OptionLevel::kBasic), advanced = lines(OptionLevel::kAdvanced);
  EXPECT_LT(basic, 110);  // two lines an option or group
  EXPECT_LT(2 * basic, advanced);
  EXPECT_LT(advanced, lines(OptionLevel::kInternal));
  arguments.form = ConfigForm::kList;
  arguments.level = OptionLevel::kBasic;
  const std::string list = config(arguments);
  const auto options = std::count(list.begin(), list.end(), '\n');
  EXPECT_GE(options, 25);
  EXPECT_LE(options, 40);
  EXPECT_THAT(list, HasSubstr("camera_height_m"));
  EXPECT_THAT(list, testing::Not(HasSubstr("ransac")));
}

TEST(ConfigCommand, ListsEveryOptionOnALine) {
  ConfigArguments arguments;
  arguments.form = ConfigForm::kList;
  arguments.level = OptionLevel::kInternal;
  arguments.settings = {"seed=11"};
  const std::string text = config(arguments);
  EXPECT_THAT("\n" + text, testing::ContainsRegex("\nseed +11 "));
  std::size_t options = 0;
  for (const OptionEntry& entry : list_options(RunOptions())) options += entry.type != "group";
  EXPECT_EQ(static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')), options);
}

TEST(ConfigCommand, KnowsTheOptionsOfFlight) {
  ConfigArguments arguments;
  arguments.of = "flight";
  arguments.form = ConfigForm::kMarkdown;
  EXPECT_THAT(config(arguments), testing::StartsWith("# Options of `placegraph flight`\n"));
  EXPECT_THAT(config(arguments), HasSubstr("marker_delay_s"));  // run has no such option
  arguments.of = "walk";
  EXPECT_THAT(message_of<ArgumentError>([&] { config(arguments); }),
              HasSubstr("--of: 'walk' is none of run, flight"));
}

TEST(ConfigCommand, KeepsAFileThatIsThereUnlessItIsForced) {
  const test::TemporaryFolder folder;
  ConfigArguments arguments;
  arguments.out = folder.write("my.yaml", "mine");
  EXPECT_THAT(message_of<ArgumentError>([&] { config(arguments); }),
              HasSubstr("my.yaml: exists already"));
  EXPECT_EQ(test::read_file(arguments.out), "mine");
}

}  // namespace config_test
}  // namespace placegraph::apps
