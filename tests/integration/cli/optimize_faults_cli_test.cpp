// `placegraph optimize`: what it refuses, and how it says so.
#include "tests/support/cli_test.h"

namespace placegraph {
namespace optimize_faults_cli_test {

namespace fs = std::filesystem;
using test::CommandResult;
using test::read_file;
using test::write_file;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string kTwoPoses = "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1.1 0 0\n";
const std::string kEdge = "EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\n";

struct Fault {
  const char* name;
  std::string text;
  const char* message;
};

class OptimizeRefuses : public test::CliTest, public ::testing::WithParamInterface<Fault> {};

TEST_P(OptimizeRefuses, WithFileAndLineAndWritesNothing) {
  write_file(dir / "bad.g2o", GetParam().text);
  expect_usage_error("optimize bad.g2o -o out.g2o --plot out.png", GetParam().message);
  EXPECT_FALSE(fs::exists(dir / "out.g2o"));
  EXPECT_FALSE(fs::exists(dir / "out.png"));
  EXPECT_EQ(read_file(dir / "bad.g2o"), GetParam().text);
}

INSTANTIATE_TEST_SUITE_P(
    Graphs, OptimizeRefuses,
    ::testing::Values(
        Fault{"Indefinite", kTwoPoses + "EDGE_SE2 0 1 1 0 0 1 0 0 -1e-6 0 1\n",
              "bad.g2o:3: the information is indefinite"},
        Fault{"AllZero", kTwoPoses + "EDGE_SE2 0 1 1 0 0 0 0 0 0 0 0\n",
              "bad.g2o:3: the information is all zero"},
        Fault{"TooLargeInformation", kTwoPoses + "EDGE_SE2 0 1 1 0 0 1e308 0 0 1e308 0 1e308\n",
              "bad.g2o:3: the information is above 1e+100"},
        Fault{"TooFarPose", "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1e308 0 0\n" + kEdge,
              "bad.g2o:2: a position beyond 1e+50 m"},
        Fault{"TooFarEdge", kTwoPoses + "EDGE_SE2 0 1 1 -1e140 0 1 0 0 1 0 1\n",
              "bad.g2o:3: a position beyond 1e+50 m"},
        Fault{"TwiceTheSameId", kTwoPoses + kEdge + "VERTEX_SE2 1 1 0 0\n",
              "bad.g2o:4: vertex 1 is there twice"},
        Fault{"MissingVertex", kTwoPoses + "EDGE_SE2 0 7 1 0 0 1 0 0 1 0 1\n",
              "bad.g2o:3: there is no vertex 7"},
        Fault{"Disconnected", kTwoPoses + kEdge + "VERTEX_SE2 2 1 0 0\n",
              "bad.g2o:4: vertex 2 is not connected with vertex 0: the graph falls into 2"},
        Fault{"NaN", kTwoPoses + "EDGE_SE2 0 1 nan 0 0 1 0 0 1 0 1\n",
              "bad.g2o:3: x: 'nan' is not finite"},
        Fault{"Infinity", "VERTEX_SE2 0 0 -inf 0\n", "bad.g2o:1: y: '-inf' is not finite"},
        Fault{"TooLargeNumber", "VERTEX_SE2 0 0 1e999 0\n", "bad.g2o:1: y: '1e999'"},
        Fault{"Truncated", kTwoPoses + "EDGE_SE2 0 1 1 0 0 1 0 0 1 0",
              "bad.g2o:3: EDGE_SE2: expected 11 numbers, found 10"},
        Fault{"Mixed", kTwoPoses + kEdge + "VERTEX_SE3:QUAT 2 0 0 0 0 0 0 1\n",
              "bad.g2o:4: SE2 and SE3 are mixed"},
        Fault{"HugeId", "VERTEX_SE2 18446744073709551616 0 0 0\n", "bad.g2o:1: id: "},
        Fault{"ClaimedCount", "10000000 10000000\n" + kTwoPoses,
              "bad.g2o:1: '10000000': not a tag"},
        Fault{"Binary", std::string("\x7f\x45\x4c\x46\0\1\2\xff\n\0\0", 11), "bad.g2o:1: "},
        Fault{"Empty", "", "bad.g2o: holds no vertices"},
        Fault{"Blank", "\n \n# nothing\n", "bad.g2o: holds no vertices"},
        Fault{"FixOfNothing", kTwoPoses + kEdge + "FIX 9\n", "bad.g2o:4: there is no vertex 9"},
        Fault{"SelfEdge", kTwoPoses + "EDGE_SE2 1 1 1 0 0 1 0 0 1 0 1\n",
              "bad.g2o:3: an edge from 1 to itself"},
        Fault{"Landmarks", "ODOMETRY 0 1 1 0 0 1 0 0 1 0 1\nLANDMARK 0 0 1 1 1 0 1\n",
              "bad.g2o:2: LANDMARK"},
        Fault{"ToroTruncated", "VERTEX2 0 0 0 0\nVERTEX2 1 0 0\n", "bad.g2o:2: VERTEX2"}),
    [](const auto& test) { return test.param.name; });

class OptimizeFaults : public test::CliTest {
 protected:
  void SetUp() override { write_file(dir / "in.g2o", kTwoPoses + kEdge); }
};

TEST_F(OptimizeFaults, NeverOverwritesUnasked) {
  for (const char* out : {"out.g2o", "out.png"}) write_file(dir / out, "mine");
  expect_usage_error("optimize in.g2o -o out.g2o", "out.g2o: exists already; --force");
  expect_usage_error("optimize in.g2o -o new.g2o --plot out.png", "out.png: exists already");
  for (const char* out : {"out.g2o", "out.png"}) EXPECT_EQ(read_file(dir / out), "mine");
  EXPECT_FALSE(fs::exists(dir / "new.g2o"));
  EXPECT_EQ(run("optimize in.g2o -o out.g2o --plot out.png --force").code, 0);
}

TEST_F(OptimizeFaults, KeepsItsInputWhereThatIsTheOutputToo) {
  const std::string before = read_file(dir / "in.g2o");
  for (const char* force : {"", " --force"})
    expect_usage_error(std::string("optimize in.g2o -o in.g2o") + force,
                       "--out: in.g2o is an input, that of IN");
  EXPECT_EQ(read_file(dir / "in.g2o"), before);
}

TEST_F(OptimizeFaults, RefusesBadOptions) {
  expect_usage_error("optimize in.g2o", "required");
  expect_usage_error("optimize -o out.g2o", "required");
  expect_usage_error("optimize absent.g2o -o out.g2o", "absent.g2o");
  expect_usage_error("optimize . -o out.g2o", ".");
  expect_usage_error("optimize in.g2o -o out.g2o --cost euler", "euler");
  expect_usage_error("optimize in.g2o -o out.g2o --engine steam", "steam");
  expect_usage_error("optimize in.g2o -o out.g2o --robust magic", "magic");
  expect_usage_error("optimize in.g2o -o out.g2o --initialization nowhere", "nowhere");
  expect_usage_error("optimize in.g2o -o out.g2o --iterations 0",
                     "--iterations: Value 0 not in range");
  expect_usage_error("optimize in.g2o -o out.g2o --iterations many", "--iterations");
  expect_usage_error("optimize in.g2o -o out.g2o --plot out.gif", ".png, .svg or .pdf");
  expect_usage_error("optimize in.g2o -o out.png --plot out.png", "--plot");
  expect_usage_error("optimize in.g2o -o no/such/folder.g2o", "folder.g2o");
  EXPECT_FALSE(fs::exists(dir / "out.g2o"));
}

TEST_F(OptimizeFaults, SaysThatNothingCanBeWrittenBeforeItWorks) {
  fs::create_symlink("/proc", dir / "unwritable");  // where not even root makes a file
  expect_usage_error("optimize in.g2o -o unwritable/out.g2o", "unwritable/out.g2o: cannot be");
  expect_usage_error("optimize in.g2o -o out.g2o --plot unwritable/out.png", "unwritable/out.png");
  expect_usage_error("optimize in.g2o -o ''", "path of an output file is empty");
  expect_usage_error("optimize in.g2o -o /dev/full --quiet", "/dev/full: cannot be written");
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
  EXPECT_FALSE(fs::exists(dir / "out.g2o"));
  run("optimize in.g2o -o /dev/stdout --quiet | cat > shown; true");
  EXPECT_THAT(read_file(dir / "shown"), HasSubstr("EDGE_SE2 0 1"));
}

TEST_F(OptimizeFaults, EndsWithOneAndWritesNothingWhereItFindsNoMinimum) {
  std::string graph;  // a ring whose start is a straight line
  for (int i = 0; i < 30; ++i) {
    graph += "VERTEX_SE2 " + std::to_string(i) + " " + std::to_string(i) + " 0 0\n";
    graph += "EDGE_SE2 " + std::to_string(i) + " " + std::to_string((i + 1) % 30) +
             " 1 0.05 0.2 100 0 0 100 0 400\n";
  }
  write_file(dir / "ring.g2o", graph);
  const CommandResult result =
      run("optimize ring.g2o -o out.g2o --initialization file --iterations 1 --quiet");
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.out, IsEmpty());
  EXPECT_THAT(result.err, HasSubstr("ring.g2o: "));
  EXPECT_FALSE(fs::exists(dir / "out.g2o"));
}

TEST_F(OptimizeFaults, RefusesNumbersWhoseCostOverflows) {
  std::string information;  // of a weight that is just taken
  for (int i = 0; i < 7; ++i)
    for (int j = i; j < 7; ++j) information += i == j ? " 1e99" : " 0";
  write_file(dir / "huge.g2o",
             "VERTEX_SIM3:EXPMAP 0 0 0 0 0 0 0 -150\nVERTEX_SIM3:EXPMAP 1 0 0 0 1e49 0 0 0\n"
             "EDGE_SIM3:EXPMAP 0 1 0 0 0 1 0 0 -150" +
                 information + "\n");
  expect_usage_error("optimize huge.g2o -o out.g2o", "huge.g2o: the cost at the given poses");
  EXPECT_FALSE(fs::exists(dir / "out.g2o"));
}

TEST_F(OptimizeFaults, GrowsNoGraphTheWayOthersAreSolved) {
  for (const char* flag : {"--engine ceres", "--robust gnc", "--initialization chordal"})
    expect_usage_error(std::string("optimize in.g2o -o out.g2o --incremental ") + flag,
                       "--incremental goes with");
}

}  // namespace optimize_faults_cli_test
}  // namespace placegraph
