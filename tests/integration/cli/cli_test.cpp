#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/cli_test.h"
#include "tests/support/data.h"
#include "tests/support/paths.h"

namespace placegraph {
namespace cli_test {

namespace fs = std::filesystem;
using test::CommandResult;
using test::read_file;
using test::run_placegraph;
using test::TemporaryFolder;
using test::write_file;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

// A drive of `frames` poses around a circle of 20 m radius in KITTI form, 1 m a frame.
std::string circle_kitti(int frames, double scale = 1, int lost = -1) {
  std::ostringstream out;
  out.precision(12);
  for (int i = 0; i < frames; ++i) {
    const double a = i / 20.0, c = std::cos(a), s = std::sin(a);
    if (i == lost)
      out << "nan nan nan nan nan nan nan nan nan nan nan nan\n";
    else
      out << c << " 0 " << s << " " << scale * 20 * (1 - c) << " 0 1 0 0 " << -s << " 0 " << c
          << " " << scale * 20 * s << "\n";
  }
  return out.str();
}

std::string circle_tum(int frames) {
  std::ostringstream out;
  out.precision(12);
  for (int i = 0; i < frames; ++i) {
    const double a = i / 20.0;
    out << 0.1 * i << " " << 20 * (1 - std::cos(a)) << " 0 " << 20 * std::sin(a) << " 0 "
        << std::sin(a / 2) << " 0 " << std::cos(a / 2) << "\n";
  }
  return out.str();
}

class Cli : public test::CliTest {
 protected:
  void SetUp() override {
    write_file(dir / "gt.txt", circle_kitti(150));
    write_file(dir / "est.txt", circle_kitti(150, 0.99, 7));
  }
};

std::vector<std::string> commands() {
  std::istringstream help(run_placegraph("--help").out);
  std::vector<std::string> names;
  bool listing = false;
  for (std::string line; std::getline(help, line);) {
    if (line == "Subcommands:") {
      listing = true;
    } else if (listing && line.size() > 3 && line[2] != ' ') {
      const std::string name = line.substr(2, line.find(' ', 2) - 2);
      if (name != "help" && name != "version") names.push_back(name);  // spellings of flags
    }
  }
  return names;
}

TEST_F(Cli, HelpOfEveryCommandBeginsWithAnExampleOfIt) {
  EXPECT_THAT(run("--help").out, StartsWith("Example: placegraph "));
  EXPECT_THAT(commands(), ::testing::IsSupersetOf({"config", "eval", "graph", "run"}));
  for (const std::string& name : commands()) {
    const CommandResult help = run(name + " --help");
    EXPECT_EQ(help.code, 0) << name;
    EXPECT_THAT(help.out, StartsWith("Example: placegraph " + name)) << name;
    EXPECT_THAT(help.err, IsEmpty()) << name;
  }
}

TEST_F(Cli, EveryCommandTakesBadUsageAsExitCodeTwoAndOneLine) {
  expect_usage_error("", "subcommand is required");
  expect_usage_error("evaluate", "");
  expect_usage_error("--frobnicate", "");
  for (const std::string& name : commands()) expect_usage_error(name + " --frobnicate", "--help");
}

TEST_F(Cli, SaysItsVersion) {
  const CommandResult result = run("--version");
  EXPECT_EQ(result.code, 0);
  EXPECT_THAT(result.out, ::testing::MatchesRegex("placegraph [0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

TEST_F(Cli, EvalPrintsFiguresWithTheirProtocol) {
  const CommandResult result = run("eval gt.txt est.txt --lengths 10,50 --step 5");
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("149 of 150 frames"));
  EXPECT_THAT(result.out, HasSubstr("align se3"));
  EXPECT_THAT(result.out, HasSubstr("lengths 10,50 m, step 5"));
}

TEST_F(Cli, EvalJsonHasTheFixedKeysAndValues) {
  const CommandResult result =
      run("eval gt.txt est.txt --align origin --lengths 10,50 --step 1 --json");
  ASSERT_EQ(result.code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  for (const char* key : {"ate_rmse_m", "t_rel_percent", "r_rel_deg_per_100m", "rpe_trans_m",
                          "rpe_rot_deg", "rpe_rot_median_deg"})
    EXPECT_TRUE(json.at(key).is_number()) << key;
  EXPECT_EQ(json.at("frames"), 150);
  EXPECT_EQ(json.at("posed"), 149);
  EXPECT_EQ(json.at("align"), "origin");
  EXPECT_EQ(json.at("scale"), 1.0);
  // A circle 1 % too small is wrong by 1 % of each step's chord.
  EXPECT_NEAR(json.at("rpe_trans_m").get<double>(), 0.01 * 2 * 20 * std::sin(0.025), 1e-9);
  const auto scaled = nlohmann::json::parse(run("eval gt.txt est.txt --align scale --json").out);
  EXPECT_NEAR(scaled.at("scale").get<double>(), 1 / 0.99, 1e-9);
  EXPECT_LT(scaled.at("ate_rmse_m").get<double>(), 1e-9);
}

TEST_F(Cli, EvalGivesNullAndAWarningForAClipThatIsTooShort) {
  const CommandResult result = run("eval gt.txt est.txt --lengths 1000 --json");
  EXPECT_EQ(result.code, 0);
  EXPECT_TRUE(nlohmann::json::parse(result.out).at("t_rel_percent").is_null());
  EXPECT_THAT(result.err, HasSubstr("warning: est.txt: no t_rel and r_rel"));
}

TEST_F(Cli, EvalRefusesToGuessTheAssociation) {
  write_file(dir / "short.txt", circle_kitti(100));
  const CommandResult lengths = run("eval gt.txt short.txt");
  EXPECT_EQ(lengths.code, 2);
  EXPECT_THAT(lengths.err, HasSubstr("the ground truth has 150, the estimate 100"));
  write_file(dir / "est.tum", circle_tum(150));
  const CommandResult times = run("eval gt.txt est.tum");
  EXPECT_EQ(times.code, 2);
  EXPECT_THAT(times.err, HasSubstr("only the estimate has times"));
}

TEST_F(Cli, EvalTakesTimesFromAFileOrFromBesideASequencesPoses) {
  write_file(dir / "est.tum", circle_tum(150));
  std::string times;
  for (int i = 0; i < 150; ++i) times += std::to_string(0.1 * i) + "\n";
  write_file(dir / "times.txt", times);
  write_file(dir / "poses.txt", circle_kitti(150));
  for (const char* arguments : {"eval gt.txt est.tum --times times.txt --json",
                                "eval poses.txt est.tum --json", "eval . est.tum --json"}) {
    const CommandResult result = run(arguments);
    ASSERT_EQ(result.code, 0) << result.err;
    const auto json = nlohmann::json::parse(result.out);
    EXPECT_EQ(json.at("association"), "time");
    EXPECT_LT(json.at("ate_rmse_m").get<double>(), 1e-6);
  }
}

TEST_F(Cli, EvalComparesSeveralEstimatesInOneTable) {
  write_file(dir / "other.txt", circle_kitti(150, 1.02));
  const CommandResult table = run("eval gt.txt est.txt other.txt");
  EXPECT_EQ(table.code, 0);
  EXPECT_THAT(table.out, HasSubstr("\nest.txt "));
  EXPECT_THAT(table.out, HasSubstr("\nother.txt "));
  const auto json = nlohmann::json::parse(run("eval gt.txt est.txt other.txt --json").out);
  EXPECT_EQ(json.at("results").size(), 2u);
}

TEST_F(Cli, EvalNamesEstimatesOfTheSameFileNameByTheirFolders) {
  for (const char* folder : {"first", "second"}) {
    fs::create_directory(dir / folder);
    write_file(dir / (std::string(folder) + "/trajectory.kitti"), circle_kitti(150));
  }
  const CommandResult table = run("eval gt.txt first/trajectory.kitti second/trajectory.kitti");
  EXPECT_THAT(table.out, HasSubstr("\nfirst "));
  EXPECT_THAT(table.out, HasSubstr("\nsecond "));
}

TEST_F(Cli, EvalPairsTheFilesOfTwoFoldersByNameAndAverages) {
  for (const char* folder : {"gt", "run"}) fs::create_directory(dir / folder);
  write_file(dir / "gt/00.txt", circle_kitti(150));
  write_file(dir / "gt/01.txt", circle_kitti(140));
  write_file(dir / "gt/02.txt", circle_kitti(140));
  write_file(dir / "run/00.kitti", circle_kitti(150, 0.99));
  write_file(dir / "run/01.txt", circle_kitti(140, 1.01));
  const CommandResult result = run("eval gt run --lengths 20 --json");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("02.txt: no file of that name"));
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json.at("results").size(), 2u);
  EXPECT_EQ(json.at("average").at("sequences"), 2);
  EXPECT_THAT(run("eval gt run").out, HasSubstr("mean over all segments"));
}

TEST_F(Cli, EvalWritesItsFilesAndNeverOverwritesThemUnasked) {
  const std::string command = "eval gt.txt est.txt --lengths 10 --csv a.csv --latex a.tex --plot ";
  ASSERT_EQ(run(command + "a.png").code, 0);
  EXPECT_THAT(read_file(dir / "a.csv"), HasSubstr(",segment,t_rel_percent,"));
  EXPECT_THAT(read_file(dir / "a.tex"), HasSubstr("\\toprule"));
  EXPECT_THAT(read_file(dir / "a.png"), StartsWith("\x89PNG"));
  write_file(dir / "a.csv", "mine");
  expect_usage_error(command + "b.svg", "a.csv: exists already; --force");
  EXPECT_EQ(read_file(dir / "a.csv"), "mine");
  EXPECT_FALSE(fs::exists(dir / "b.svg"));
  EXPECT_EQ(run(command + "b.svg --force").code, 0);
  EXPECT_THAT(read_file(dir / "b.svg"), StartsWith("<svg"));
  for (const fs::directory_entry& entry : fs::directory_iterator(dir.path()))
    EXPECT_THAT(entry.path().filename().string(), ::testing::Not(HasSubstr("tmp")));
}

/// The commands of the first block of shell lines of a page.
std::vector<std::string> first_commands(const std::string& page) {
  std::istringstream text(page.substr(page.find("```sh\n") + 6));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line) && line != "```";)
    lines.push_back(line.substr(0, line.find('#')).substr(std::string("placegraph ").size()));
  return lines;
}

TEST_F(Cli, EvalGoesFromTwoFilesToAFigureAndATableAsItsPageSays) {
  write_file(dir / "truth.tum", circle_tum(900));
  write_file(dir / "estimate.tum", circle_tum(900));
  const std::vector<std::string> commands =
      first_commands(read_file(test::source_dir() + "/docs/evaluation.md"));
  EXPECT_EQ(commands.size(), 3u);
  for (const std::string& command : commands) {
    const CommandResult result = run(command);
    EXPECT_EQ(result.code, 0) << command << ": " << result.err;
  }
  EXPECT_THAT(read_file(dir / "figure.pdf"), StartsWith("%PDF"));
  EXPECT_THAT(read_file(dir / "table.tex"), HasSubstr("\\toprule"));
}

TEST_F(Cli, EvalNamesFileAndLineOfMalformedInput) {
  write_file(dir / "broken.txt", circle_kitti(3) + "1 0 0 0 0 1 0 0 0 0 1\n");
  expect_usage_error("eval gt.txt broken.txt", "broken.txt:4:");
  write_file(dir / "word.txt", "1 0 0 0 0 1 0 0 0 0 1 zero\n");
  expect_usage_error("eval gt.txt word.txt", "word.txt:1:");
  write_file(dir / "empty.txt", "");
  expect_usage_error("eval gt.txt empty.txt", "empty.txt");
  write_file(dir / "binary.txt", std::string("\0\1\2\n\xff\xfe\n\0", 8));
  expect_usage_error("eval gt.txt binary.txt", "binary.txt");
}

TEST_F(Cli, EvalRefusesBadOptions) {
  expect_usage_error("eval gt.txt", "ESTIMATE is required");
  expect_usage_error("eval gt.txt absent.txt", "absent.txt");
  expect_usage_error("eval gt.txt est.txt --align affine", "affine");
  expect_usage_error("eval gt.txt est.txt --lengths 10,-5", "segments.lengths_m");
  expect_usage_error("eval gt.txt est.txt --lengths ten", "--lengths");
  expect_usage_error("eval gt.txt est.txt --step 0", "segments.step");
  expect_usage_error("eval gt.txt est.txt --plot a.gif", ".png, .svg or .pdf");
  expect_usage_error("eval gt.txt .", "is a folder");
  expect_usage_error("eval gt.txt est.txt --csv no/such/folder.csv", "folder.csv");
}

TEST_F(Cli, BundleAdjustsAProblemAndReportsItsCost) {
  // Four cameras a metre apart that see twelve points, one of them 3 px off.
  std::string problem = "4 12 48\n", points;
  for (int i = 0; i < 12; ++i) {
    const double x = i % 4 - 1.5, y = i / 4 - 1.0, z = -5.0 - i % 3;
    for (int camera = 0; camera < 4; ++camera)
      problem += std::to_string(camera) + " " + std::to_string(i) + " " +
                 std::to_string(-500 * (x - camera) / z) + " " +
                 std::to_string(-500 * y / z + (i + camera == 0 ? 3 : 0)) + "\n";
    points += std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + "\n";
  }
  std::string cameras;
  for (int camera = 0; camera < 4; ++camera)
    cameras += "0 0 0 " + std::to_string(-camera) + " 0 0 500 0 0\n";
  write_file(dir / "in.txt", problem + cameras + points);
  const CommandResult result = run("graph bundle in.txt -o out.txt --json");
  ASSERT_EQ(result.code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_NEAR(json.at("cost_initial").get<double>(), 4.5, 1e-3);
  EXPECT_LT(json.at("cost").get<double>(), 4.5);
  EXPECT_EQ(json.at("observations"), 48);
  for (const char* key : {"rms_px", "cpu_ms", "wall_ms"})
    EXPECT_TRUE(json.at(key).is_number()) << key;
  EXPECT_EQ(run("graph bundle out.txt --kernel cauchy").code, 0);
  expect_usage_error("graph bundle in.txt -o out.txt", "--force");
  write_file(dir / "cut.txt", problem);
  expect_usage_error("graph bundle cut.txt", "ends where a camera parameter is expected");
  write_file(dir / "empty.txt", "0 0 0\n");
  EXPECT_EQ(run("graph bundle empty.txt").code, 1);
}

TEST_F(Cli, ConfigDumpsWhatItTakesBack) {
  const CommandResult dump = run("config --all --set seed=42");
  ASSERT_EQ(dump.code, 0) << dump.err;
  write_file(dir / "mine.yaml", dump.out);
  EXPECT_EQ(run("config --all --config mine.yaml").out, dump.out);
  EXPECT_NE(run("config --all").out, dump.out);
  EXPECT_THAT(run("config").out, HasSubstr("seed"));
}

TEST_F(Cli, ConfigNamesUnknownKeysAndWrongValues) {
  write_file(dir / "unknown.yaml", "seed: 3\nno_such_option: 1\n");
  expect_usage_error("config --config unknown.yaml", "unknown.yaml:2: no_such_option");
  write_file(dir / "type.yaml", "seed: many\n");
  expect_usage_error("config --config type.yaml", "type.yaml:1: seed");
  expect_usage_error("config --set no.such.option=1", "no.such.option");
  expect_usage_error("config --all --markdown", "");
  write_file(dir / "kept.yaml", "mine");
  expect_usage_error("config --all --out kept.yaml", "--force");
  EXPECT_EQ(read_file(dir / "kept.yaml"), "mine");
}

TEST_F(Cli, OptionsDocumentIsTheOneConfigPrints) {
  const CommandResult result = run("config --markdown");
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(read_file(test::source_dir() + "/docs/options.md"), result.out)
      << "run `placegraph config --markdown --out docs/options.md --force`";
}

TEST_F(Cli, RunNeedsASequenceItRecognizes) {
  fs::create_directory(dir / "nothing");
  expect_usage_error("run nothing --out out", "nothing");
  expect_usage_error("run nothing", "--out");
  write_file(dir / "out", "mine");
  expect_usage_error("run nothing --out out", "is a file");
  EXPECT_EQ(read_file(dir / "out"), "mine");
}

TEST_F(Cli, EvalReproducesAPublishedRow) {
  PLACEGRAPH_DATA_OR_SKIP(golden, "golden");
  const CommandResult result =
      run("eval " + golden + "/KITTI_00_gt.txt " + golden + "/KITTI_00_ORB.txt --json");
  ASSERT_EQ(result.code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_NEAR(json.at("t_rel_percent").get<double>(), 0.69973, 5e-6);
  EXPECT_NEAR(json.at("r_rel_deg_per_100m").get<double>(), 0.25333, 5e-6);
  EXPECT_NEAR(json.at("ate_rmse_m").get<double>(), 1.30345, 5e-6);
}

}  // namespace cli_test
}  // namespace placegraph
