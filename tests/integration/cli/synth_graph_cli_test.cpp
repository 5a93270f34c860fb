// `placegraph synth graph`.
#include <sstream>
#include <vector>

#include "tests/support/cli_test.h"

namespace placegraph {
namespace synth_graph_cli_test {

namespace fs = std::filesystem;
using test::CommandResult;
using test::read_file;
using test::write_file;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class SynthGraphCli : public test::CliTest {};

TEST_F(SynthGraphCli, MakesEveryWorldAndTheSameOneForTheSameSeed) {
  struct World {
    const char *arguments, *tag;
  };
  for (const World& world :
       {World{"manhattan-walk --poses 60 --loop-share 0.3", "VERTEX_SE2 59 "},
        World{"grid-world --poses 60 --rotation-noise 0.02", "VERTEX_SE3:QUAT 59 "},
        World{"long-loop --poses 60 --closures 3 --laps 1.5", "VERTEX_SE2 59 "},
        World{"long-loop --poses 60 --3d --closures 2 --translation-noise 0.1",
              "VERTEX_SE3:QUAT 59 "}}) {
    const std::string command = std::string("synth graph ") + world.arguments + " --force -o ";
    const CommandResult result = run(command + "a.g2o");
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("60 poses"));
    EXPECT_THAT(read_file(dir / "a.g2o"), HasSubstr(world.tag));
    run(command + "b.g2o");
    run(command + "c.g2o --seed 2");
    EXPECT_EQ(read_file(dir / "a.g2o"), read_file(dir / "b.g2o"));
    EXPECT_NE(read_file(dir / "a.g2o"), read_file(dir / "c.g2o"));
  }
}

TEST_F(SynthGraphCli, DisturbsTheOdometryOfAFile) {
  run("synth graph manhattan-walk --poses 60 -o a.g2o");
  const CommandResult result = run("synth graph a.g2o --rotation-noise 0.1 -o b.g2o");
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(read_file(dir / "b.g2o"), StartsWith("VERTEX_SE2 0 "));
  EXPECT_NE(read_file(dir / "a.g2o"), read_file(dir / "b.g2o"));
}

/// "from to" of every edge; reading and writing again may change the last digit of an angle.
std::vector<std::string> edges(const std::string& path) {
  std::istringstream in(read_file(path));
  std::vector<std::string> edges;
  for (std::string line, tag, from, to; std::getline(in, line);)
    if (std::istringstream(line) >> tag >> from >> to && tag == "EDGE_SE2")
      edges.push_back(from + " " + to);
  return edges;
}

TEST_F(SynthGraphCli, AddsFalseLoopsBehindTheOthersAndShuffles) {
  run("synth graph manhattan-walk --poses 100 -o true.g2o");
  ASSERT_EQ(run("synth graph true.g2o --false-loops 5 -o false.g2o").code, 0);
  std::vector<std::string> truth = edges(dir / "true.g2o"), with = edges(dir / "false.g2o");
  ASSERT_EQ(with.size(), truth.size() + 5);
  EXPECT_TRUE(std::equal(truth.begin(), truth.end(), with.begin()));
  ASSERT_EQ(run("synth graph false.g2o --shuffle -o shuffled.g2o").code, 0);
  std::vector<std::string> shuffled = edges(dir / "shuffled.g2o");
  EXPECT_NE(shuffled, with);
  std::sort(with.begin(), with.end());
  std::sort(shuffled.begin(), shuffled.end());
  EXPECT_EQ(shuffled, with);
}

TEST_F(SynthGraphCli, RefusesWhatDoesNotBelongTogether) {
  expect_usage_error("synth graph castle -o a.g2o", "castle: neither manhattan-walk");
  expect_usage_error("synth graph manhattan-walk --laps 2 -o a.g2o", "--laps is no option of");
  expect_usage_error("synth graph grid-world --closures 2 -o a.g2o", "--closures is no option");
  expect_usage_error("synth graph grid-world --3d -o a.g2o", "--3d is no option");
  expect_usage_error("synth graph long-loop --loop-share 1 -o a.g2o", "--loop-share is no option");
  expect_usage_error("synth graph long-loop --poses 0 -o a.g2o", "poses");
  write_file(dir / "in.g2o", "VERTEX_SE2 0 0 0 0\n");
  expect_usage_error("synth graph in.g2o -o a.g2o", "--rotation-noise");
  expect_usage_error("synth graph in.g2o --false-loops 3 -o a.g2o", "the graph has no loop");
  expect_usage_error("synth graph grid-world --false-loops -1 -o a.g2o",
                     "--false-loops: Value -1 not in range");
  expect_usage_error("synth graph grid-world --poses 2000000000 -o a.g2o",
                     "--poses: Value 2000000000 not in range");
  expect_usage_error("synth graph in.g2o --rotation-noise 1 --poses 3 -o a.g2o", "--poses");
  expect_usage_error("synth graph grid-world -o in.g2o", "--force");
  EXPECT_FALSE(fs::exists(dir / "a.g2o"));
}

}  // namespace synth_graph_cli_test
}  // namespace placegraph
