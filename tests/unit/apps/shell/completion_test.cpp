#include "apps/shell/completion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>

#include <cstdio>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/apps/shell/small_command_line.h"

namespace placegraph::apps {
namespace completion_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class Completion : public ::testing::Test {
 protected:
  /// What bash offers for the last of these words.
  std::string offered(const std::vector<std::string>& words) {
    std::string script = completion_script(line.app, "bash") + "COMP_WORDS=(placegraph";
    for (const std::string& word : words) script += " '" + word + "'";
    script += ")\nCOMP_CWORD=" + std::to_string(words.size()) +
              "\n_placegraph_words\necho -n \"${COMPREPLY[*]}\"\n";
    const std::string command = "bash '" + dir.write("script", script) + "'";
    std::FILE* pipe = ::popen(command.c_str(), "r");
    std::string out(4096, '\0');
    out.resize(std::fread(out.data(), 1, out.size(), pipe));
    EXPECT_EQ(::pclose(pipe), 0);
    return out;
  }
  test::TemporaryFolder dir;
  SmallCommandLine line;
};

TEST_F(Completion, BashOffersCommandsWhereTheyBelong) {
  EXPECT_THAT(offered({""}), StartsWith("map run "));  // and short forms
  EXPECT_EQ(offered({"ru"}), "run");
  EXPECT_EQ(offered({"map", ""}), "info draw");
  EXPECT_EQ(offered({"map", "d"}), "draw");
  EXPECT_EQ(offered({"map", "info", ""}), "");  // bash completes a file
  EXPECT_EQ(offered({"hid"}), "");
  EXPECT_EQ(offered({"optimi"}), "optimize");
}

TEST_F(Completion, BashOffersFlagsBehindADashAndTheirChoices) {
  EXPECT_EQ(offered({"map", "info", "-"}), "--help --kind --json");
  EXPECT_EQ(offered({"map", "info", "a.db", "--j"}), "--json");
  EXPECT_EQ(offered({"map", "info", "--kind", ""}), "short long");
  EXPECT_EQ(offered({"map", "info", "--kind", "l"}), "long");
  EXPECT_EQ(offered({"map", "info", "--kind", "long", "--k"}), "--kind");
  EXPECT_EQ(offered({"run", "--f"}), "--frames");
  EXPECT_EQ(offered({"run", "--frames", ""}), "");
  EXPECT_EQ(offered({"run", "map", "--k"}), "");  // a file of the name of a command
}

TEST_F(Completion, FishConditionsHoldForOneCommandAlone) {
  const std::string script = completion_script(line.app, "fish");
  EXPECT_THAT(script, HasSubstr("complete -c placegraph -n '__fish_use_subcommand' -f -a map -d "
                                "'Saved maps'\n"));
  EXPECT_THAT(script,
              HasSubstr("-n '__fish_seen_subcommand_from map; and not __fish_seen_subcommand_from "
                        "info; and not __fish_seen_subcommand_from draw' -f -a draw -d 'Draw"));
  const std::string info =
      "-n '__fish_seen_subcommand_from map; and __fish_seen_subcommand_from info' ";
  EXPECT_THAT(script, HasSubstr(info + "-l kind -d 'kind of a|b' -x -a 'short long'\n"));
  EXPECT_THAT(script, HasSubstr(info + "-l json -d 'print .json \\\\ nothing else'\n"));
  EXPECT_THAT(script, HasSubstr("-a info -d 'Tell what a map <holds>, it\\'s *all*'\n"));
  EXPECT_THAT(script, Not(HasSubstr("secret")));
}

TEST_F(Completion, ZshRunsTheFunctionOfBash) {
  const std::string bash = completion_script(line.app, "bash"),
                    zsh = completion_script(line.app, "zsh");
  const std::string function =
      bash.substr(bash.find("_placegraph_words() {"), bash.find("\ncomplete ") -
                                                          bash.find("_placegraph_words() {"));
  EXPECT_THAT(zsh, StartsWith("#compdef placegraph\n"));
  EXPECT_THAT(zsh, HasSubstr(function));
  EXPECT_THAT(completion_shells(), ElementsAre("bash", "fish", "zsh"));
  EXPECT_EQ(test::message_of<ArgumentError>([&] { (void)completion_script(line.app, "tcsh"); }),
            "completion: 'tcsh' is not one of bash, fish, zsh");
}

}  // namespace completion_test
}  // namespace placegraph::apps
