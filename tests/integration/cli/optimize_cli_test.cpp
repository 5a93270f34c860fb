// `placegraph optimize`: what it finds and reports.
#include <nlohmann/json.hpp>

#include <cmath>
#include <numbers>
#include <sstream>

#include "tests/support/cli_test.h"
#include "tests/support/data.h"

namespace placegraph {
namespace optimize_cli_test {

namespace fs = std::filesystem;
using nlohmann::json;
using test::CommandResult;
using test::read_file;
using test::write_file;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

const char* const kThreePoses =
    "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1.1 0 0\nVERTEX_SE2 2 2.3 0.1 0\n"
    "EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\nEDGE_SE2 1 2 1 0 0 1 0 0 1 0 1\n"
    "EDGE_SE2 0 2 2.2 0 0 1 0 0 1 0 1\n";
// Three measurements of two lengths, 1, 1 and 2.2 m: 0.2 m spread over three edges.
constexpr double kThreePosesCost = 0.2 * 0.2 / 3;

/// A ring of `n` poses a metre apart, measured exactly, whose start is a tenth too wide; ids from
/// `first`, edges to the next and the one after; one more for every pair of `false_loops`.
std::string ring(int n, int first = 0, const std::vector<std::pair<int, int>>& false_loops = {}) {
  std::ostringstream out;
  out.precision(15);
  const double rotation = 2 * std::numbers::pi / n;
  const char* information = " 100 0 0 100 0 400\n";
  const double radius = 1.1 * 0.5 / std::sin(rotation / 2);
  for (int i = 0; i < n; ++i)
    out << "VERTEX_SE2 " << first + i << " " << radius * std::sin(i * rotation) << " "
        << radius * (1 - std::cos(i * rotation)) << " " << i * rotation << "\n";
  for (int i = 0; i < n; ++i) {
    out << "EDGE_SE2 " << first + i << " " << first + (i + 1) % n << " 1 0 " << rotation
        << information;
    out << "EDGE_SE2 " << first + i << " " << first + (i + 2) % n << " " << 1 + std::cos(rotation)
        << " " << std::sin(rotation) << " " << 2 * rotation << information;
  }
  for (const auto& [from, to] : false_loops)
    out << "EDGE_SE2 " << first + from << " " << first + to << " 0 0 0" << information;
  return out.str();
}

class OptimizeCli : public test::CliTest {
 protected:
  void SetUp() override { write_file(dir / "in.g2o", kThreePoses); }
  json optimized(const std::string& arguments) {
    const CommandResult result = run("optimize " + arguments + " --json --force");
    EXPECT_EQ(result.code, 0) << result.err;
    return result.code == 0 ? json::parse(result.out) : json();
  }
};

TEST_F(OptimizeCli, WritesTheGraphAndReportsBothCosts) {
  const json report = optimized("in.g2o -o out.g2o --initialization file");
  for (const char* key : {"chi2_g2o", "chi2_log", "chi2_g2o_initial", "chi2_log_initial", "cpu_ms",
                          "wall_ms", "peak_mb"})
    EXPECT_TRUE(report.at(key).is_number()) << key;
  EXPECT_GT(report.at("iterations"), 0);
  EXPECT_GT(report.at("peak_mb"), 1);
  EXPECT_NEAR(report.at("chi2_log").get<double>(), kThreePosesCost, 1e-6);
  EXPECT_EQ(report.at("kind"), "SE2");
  EXPECT_EQ(report.at("components"), 1);
  EXPECT_TRUE(report.at("rejected_edges").empty());
  EXPECT_THAT(read_file(dir / "out.g2o"), HasSubstr("VERTEX_SE2 2"));
}

TEST_F(OptimizeCli, SaysTheSameInWords) {
  const CommandResult result = run("optimize in.g2o -o out.g2o --cost g2o");
  EXPECT_EQ(result.code, 0);
  EXPECT_THAT(result.out, HasSubstr("3 nodes, 3 constraints, minimized in the g2o convention"));
  EXPECT_THAT(result.out, HasSubstr("-> 0.0133"));
}

TEST_F(OptimizeCli, FindsTheSameMinimumWithBothEngines) {
  write_file(dir / "ring.g2o", ring(30));
  for (const char* cost : {"log", "g2o"})
    for (const char* graph : {"in.g2o", "ring.g2o"}) {
      const std::string arguments = graph + std::string(" -o out.g2o --cost ") + cost;
      const double native = optimized(arguments + " --engine native").at("chi2_log");
      const double ceres = optimized(arguments + " --engine ceres").at("chi2_log");
      EXPECT_NEAR(native, ceres, 1e-6 * ceres + 1e-9) << arguments;
    }
}

TEST_F(OptimizeCli, WritesTheCovarianceOfEveryPose) {
  // Two edges in a row and one over both, each with the information 1 along x: that of the three
  // measurements of x1 and x2 is [[2, -1], [-1, 2]], its inverse [[2, 1], [1, 2]] / 3.
  optimized("in.g2o -o out.g2o --covariances covariances.csv");
  std::istringstream table(read_file(dir / "covariances.csv"));
  std::string line;
  ASSERT_TRUE(std::getline(table, line));
  EXPECT_EQ(line, "node,x:x,x:y,x:angle,y:y,y:angle,angle:angle");
  ASSERT_TRUE(std::getline(table, line));
  EXPECT_EQ(line, "0,0,0,0,0,0,0");  // the pose that is held
  for (const char* node : {"1", "2"}) {
    ASSERT_TRUE(std::getline(table, line));
    ASSERT_THAT(line, StartsWith(std::string(node) + ","));
    EXPECT_NEAR(std::stod(line.substr(2)), 2.0 / 3, 1e-3);
  }
  EXPECT_FALSE(std::getline(table, line));
}

TEST_F(OptimizeCli, RefusesCovariancesThatDoNotExistOrHaveNoPlace) {
  write_file(dir / "open.g2o",
             "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 0\nEDGE_SE2 0 1 1 0 0 1 0 0 1 0 0\n");
  expect_failure("optimize open.g2o -o out.g2o --covariances c.csv --quiet", 1,
                 "no covariances: the constraints leave directions undetermined");
  EXPECT_FALSE(fs::exists(dir / "out.g2o"));
  EXPECT_FALSE(fs::exists(dir / "c.csv"));
  expect_usage_error("optimize in.g2o -o out.g2o --covariances out.g2o",
                     "--covariances: out.g2o is where another output is to be written");
}

TEST_F(OptimizeCli, ReadsOtherFormsAndWritesThatOfG2o) {
  write_file(
      dir / "toro.graph",
      "VERTEX2 0 0 0 0\nVERTEX2 1 1.1 0 0\nVERTEX2 2 2.3 0.1 0\nEDGE2 0 1 1 0 0 1 0 1 1 0 0\n"
      "EDGE2 1 2 1 0 0 1 0 1 1 0 0\nEDGE2 0 2 2.2 0 0 1 0 1 1 0 0\n");
  write_file(dir / "isam.txt",
             "ODOMETRY 0 1 1 0 0 1 0 0 1 0 1\nODOMETRY 1 2 1 0 0 1 0 0 1 0 1\n"
             "EDGE2 0 2 2.2 0 0 1 0 0 1 0 1\n");
  for (const char* graph : {"toro.graph", "isam.txt"}) {
    EXPECT_NEAR(optimized(graph + std::string(" -o out.g2o")).at("chi2_log").get<double>(),
                kThreePosesCost, 1e-6);
    EXPECT_THAT(read_file(dir / "out.g2o"), StartsWith("VERTEX_SE2 0 "));
  }
}

TEST_F(OptimizeCli, OptimizesSimilarities) {
  // A scale that drifts by a tenth a step, closed by a loop.
  std::ostringstream out;
  const char* information = " 1 0 0 0 0 0 0 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1\n";
  for (int i = 0; i < 4; ++i)
    out << "VERTEX_SIM3:EXPMAP " << i << " 0 0 0 " << i << " 0 0 0 1 1 0 0\n";
  for (int i = 0; i < 3; ++i)
    out << "EDGE_SIM3:EXPMAP " << i << " " << i + 1 << " 0 0 0 1 0 0 -0.1" << information;
  out << "EDGE_SIM3:EXPMAP 0 3 0 0 0 3 0 0 0" << information;
  write_file(dir / "sim3.g2o", out.str());
  const json report = optimized("sim3.g2o -o out.g2o");
  EXPECT_EQ(report.at("kind"), "Sim3");
  EXPECT_LT(report.at("chi2_log"), report.at("chi2_log_initial"));
  EXPECT_THAT(read_file(dir / "out.g2o"), HasSubstr("VERTEX_SIM3:EXPMAP 3 "));
}

TEST_F(OptimizeCli, TakesAnyIdsRepeatedEdgesAndInformationOfAnyRank) {
  write_file(dir / "ids.g2o",
             "VERTEX_SE2 9223372036854775807 0 0 0\nVERTEX_SE2 -9223372036854775808 1 0 0\n"
             "EDGE_SE2 9223372036854775807 -9223372036854775808 1 0 0 1 0 0 1 0 1\n"
             "EDGE_SE2 9223372036854775807 -9223372036854775808 3 0 0 1 0 0 1 0 1\n"
             "EDGE_SE2 9223372036854775807 -9223372036854775808 2 0 0 7 0 0 0 0 0\n");
  EXPECT_NEAR(optimized("ids.g2o -o out.g2o").at("chi2_log").get<double>(), 2, 1e-9);
}

TEST_F(OptimizeCli, ReportsEveryIterationOnStandardErrorUnlessQuiet) {
  write_file(dir / "ring.g2o", ring(30));
  const CommandResult loud = run("optimize ring.g2o -o a.g2o --initialization file --json");
  const int lines = static_cast<int>(std::count(loud.err.begin(), loud.err.end(), '\n'));
  EXPECT_GE(lines, json::parse(loud.out).at("iterations").get<int>()) << loud.err;
  EXPECT_THAT(loud.err, HasSubstr("cost"));
  const CommandResult quiet =
      run("optimize ring.g2o -o b.g2o --initialization file --json --quiet");
  EXPECT_THAT(quiet.err, IsEmpty());
  EXPECT_EQ(read_file(dir / "a.g2o"), read_file(dir / "b.g2o"));
}

TEST_F(OptimizeCli, OptimizesTheComponentsOfAGraphEachForItselfWhenAsked) {
  write_file(dir / "two.g2o", ring(12) + ring(30, 100) + "VERTEX_SE2 500 1 2 3\n");
  const json report = optimized("two.g2o -o out.g2o --components");
  EXPECT_EQ(report.at("components"), 3);
  EXPECT_LT(report.at("chi2_log"), 1e-6);
  EXPECT_THAT(read_file(dir / "out.g2o"), HasSubstr("VERTEX_SE2 500 1 2 3\n"));
}

TEST_F(OptimizeCli, NamesTheLoopsItRejectsAndLeavesThemOutOfTheCost) {
  write_file(dir / "false.g2o", ring(40, 0, {{3, 21}, {8, 30}}));
  const json report = optimized("false.g2o -o out.g2o --robust gnc");
  ASSERT_EQ(report.at("rejected_edges").size(), 2u);
  EXPECT_EQ(report.at("rejected"), 2);
  const json& edge = report.at("rejected_edges").at(0);
  EXPECT_EQ(edge.at("from"), 3);
  EXPECT_EQ(edge.at("to"), 21);
  EXPECT_GT(edge.at("chi2"), 1000);
  EXPECT_TRUE(edge.at("reason").is_string());
  EXPECT_LT(report.at("chi2_log"), 1e-6);
  EXPECT_THAT(read_file(dir / "out.g2o"), HasSubstr("EDGE_SE2 3 21 "));
  optimized("false.g2o -o out.g2o --robust gnc --drop-rejected");
  EXPECT_THAT(read_file(dir / "out.g2o"), Not(HasSubstr("EDGE_SE2 3 21 ")));
  EXPECT_THAT(read_file(dir / "out.g2o"), HasSubstr("EDGE_SE2 3 5 "));
}

TEST_F(OptimizeCli, NamesRejectedLoopsOfEveryComponent) {
  write_file(dir / "two.g2o", ring(40, 100, {{3, 21}}) + ring(40, 0, {{8, 30}}));
  const json report = optimized("two.g2o -o out.g2o --components --robust gnc");
  ASSERT_EQ(report.at("rejected_edges").size(), 2u);
  EXPECT_EQ(report.at("rejected_edges").at(0).at("from"), 103);
  EXPECT_EQ(report.at("rejected_edges").at(1).at("from"), 8);
}

TEST_F(OptimizeCli, TakesEveryRobustMethod) {
  write_file(dir / "false.g2o", ring(40, 0, {{3, 21}}));
  for (const char* method : {"none", "huber", "dcs", "gnc", "pcm", "auto"}) {
    const json report = optimized(std::string("false.g2o -o out.g2o --robust ") + method);
    EXPECT_EQ(report.at("robust"), method);
  }
}

TEST_F(OptimizeCli, BeginsAtTheGivenPoses) {
  write_file(dir / "ring.g2o", ring(30));
  for (const char* start : {"auto", "file", "odometry", "chordal", "certified"}) {
    const json report = optimized(std::string("ring.g2o -o out.g2o --initialization ") + start);
    EXPECT_LT(report.at("chi2_log"), 1e-6) << start;
    if (start != std::string("auto")) {
      EXPECT_EQ(report.at("initialization"), start);
    }
    EXPECT_EQ(report.at("refined_from_certified"), report.at("initialization") == "certified");
  }
}

TEST_F(OptimizeCli, CertifiesTheIsotropicChordalProblemAndClaimsNoMore) {
  write_file(dir / "ring.g2o", ring(30));
  const json report = optimized("ring.g2o -o out.g2o --certify");
  EXPECT_EQ(report.at("certified"), true);
  EXPECT_EQ(report.at("certified_problem"), "chordal_isotropic");
  for (const char* key :
       {"certificate_gap", "smallest_eigenvalue", "certificate_lower_bound", "certificate_cpu_ms"})
    EXPECT_TRUE(report.at(key).is_number()) << key;
  EXPECT_THAT(run("optimize ring.g2o -o out.g2o --certify --force").out,
              HasSubstr("\n  certified"));
  const json without = optimized("ring.g2o -o out.g2o");
  EXPECT_EQ(without.at("certified"), false);
  EXPECT_TRUE(without.at("certified_problem").is_null());
}

TEST_F(OptimizeCli, CertifiesWithoutTheLoopsThatWereRejected) {
  write_file(dir / "false.g2o", ring(40, 0, {{3, 21}}));
  EXPECT_EQ(optimized("false.g2o -o out.g2o --robust gnc --certify").at("certified"), true);
}

TEST_F(OptimizeCli, LetsAGraphGrowAndReportsItsSteps) {
  write_file(dir / "ring.g2o", ring(30) + ring(12, 100));
  const json report = optimized("ring.g2o -o out.g2o --incremental --components");
  EXPECT_LT(report.at("chi2_log"), 1e-6);
  EXPECT_EQ(report.at("steps"), 42);
  EXPECT_GT(report.at("step_cpu_ms_mean"), 0);
  EXPECT_GE(report.at("step_cpu_ms_max"), report.at("step_cpu_ms_p95"));
  EXPECT_NEAR(optimized("in.g2o -o out.g2o --incremental").at("chi2_log").get<double>(),
              kThreePosesCost, 1e-6);
  EXPECT_FALSE(optimized("in.g2o -o out.g2o").contains("step_cpu_ms_mean"));
}

TEST_F(OptimizeCli, DrawsThePosesBeforeAndAfter) {
  write_file(dir / "false.g2o", ring(40, 0, {{3, 21}}));
  optimized("false.g2o -o out.g2o --robust gnc --plot a.svg");
  const std::string svg = read_file(dir / "a.svg");
  for (const char* text : {">before<", ">after<", "40 poses, 81 constraints", ">1 rejected<"})
    EXPECT_THAT(svg, HasSubstr(text));
  optimized("false.g2o -o out.g2o --plot a.png");
  EXPECT_THAT(read_file(dir / "a.png"), StartsWith("\x89PNG"));
}

TEST_F(OptimizeCli, ReachesAPublishedOptimum) {
  PLACEGRAPH_DATA_OR_SKIP(intel, "posegraphs/intel.g2o");
  EXPECT_LE(optimized(intel + " -o out.g2o").at("chi2_log"), 45.00423309 * (1 + 1e-6));
  EXPECT_LE(optimized(intel + " -o out.g2o --cost g2o").at("chi2_g2o"), 45.00469581 * (1 + 1e-6));
}

}  // namespace optimize_cli_test
}  // namespace placegraph
