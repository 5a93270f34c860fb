// Pose graphs as people have them: files of the cases folder with right values, and others of their
// kinds.
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "tests/support/cli_test.h"
#include "tests/support/data.h"

namespace placegraph {
namespace field_graph_test {

using nlohmann::json;
using test::CommandResult;
using testing::HasSubstr;
using testing::IsEmpty;

class FieldGraphs : public test::CliTest {
 protected:
  static std::string file(const std::string& relative) {
    return test::cases_dir() + "/" + relative;
  }
  json optimize(const std::string& path, const std::string& options = "") {
    const CommandResult result =
        run("optimize " + path + " -o out.g2o --force --quiet --json " + options);
    EXPECT_EQ(result.code, 0) << result.err;
    printed = result.err;
    return result.code == 0 ? json::parse(result.out) : json();
  }
  std::vector<std::pair<int, int>> rejected(const json& report) const {
    std::vector<std::pair<int, int>> edges;
    for (const json& edge : report["rejected_edges"]) edges.emplace_back(edge["from"], edge["to"]);
    std::ranges::sort(edges);
    return edges;
  }
  std::string printed;
};

/// A walk of 40 steps round a square, with noise of `factor` times what the information promises as
/// a variance; the loops given lead from one id to another, the false ones 4 m beside it.
std::string noisy_square(double factor, const std::vector<std::pair<int, int>>& loops,
                         const std::vector<std::pair<int, int>>& false_loops) {
  std::mt19937 generator(4);
  std::normal_distribution<double> normal;
  const auto position = [](int i) {
    const int side = i / 10 % 4, along = i % 10;
    const double corners[4][2] = {{0, 0}, {10, 0}, {10, 10}, {0, 10}};
    const double steps[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    return std::array<double, 3>{corners[side][0] + along * steps[side][0],
                                 corners[side][1] + along * steps[side][1],
                                 side * 1.5707963267948966};
  };
  std::ostringstream out;
  out.precision(17);
  const double weight = 1 / factor;
  const auto edge = [&](int from, int to, double beside) {
    const auto a = position(from), b = position(to);
    const double dx = b[0] - a[0], dy = b[1] - a[1], c = std::cos(a[2]), s = std::sin(a[2]);
    out << "EDGE_SE2 " << from << " " << to << " " << c * dx + s * dy + 0.05 * normal(generator)
        << " " << -s * dx + c * dy + beside + 0.05 * normal(generator) << " "
        << std::remainder(b[2] - a[2], 6.283185307179586) + 0.01 * normal(generator) << " "
        << 400 * weight << " 0 0 " << 400 * weight << " 0 " << 10000 * weight << "\n";
  };
  for (int i = 0; i < 41; ++i) {
    const auto p = position(i);
    out << "VERTEX_SE2 " << i << " " << p[0] << " " << p[1] << " " << p[2] << "\n";
  }
  for (int i = 0; i < 40; ++i) edge(i, i + 1, 0);
  for (const auto& [from, to] : loops) edge(from, to, 0);
  for (const auto& [from, to] : false_loops) edge(from, to, 4);
  return out.str();
}

/// Costs that scipy, numpy and gtsam find; see the texts beside the files.
TEST_F(FieldGraphs, EdgesAloneAndFixedPartsHaveTheCostsThatOthersFind) {
  PLACEGRAPH_CASE_OR_SKIP("graph_g2o_edges_alone");
  PLACEGRAPH_CASE_OR_SKIP("graph_toro_edges_alone");
  PLACEGRAPH_CASE_OR_SKIP("graph_parts_that_are_fixed");
  for (const auto& [name, cost] :
       {std::pair("graph_g2o_edges_alone/edges.g2o", 4.446071),
        std::pair("graph_g2o_edges_alone/edges_space.g2o", 5.470200),
        std::pair("graph_toro_edges_alone/edges.graph", 3.844451),
        std::pair("graph_toro_edges_alone/with_vertices.graph", 3.844451),
        std::pair("graph_parts_that_are_fixed/two_fixed_parts.g2o", 0.0)})
    EXPECT_NEAR(optimize(file(name))["chi2_log"].get<double>(), cost, 2e-6) << name;
  // One part is fixed, the other is not: the refusal names the way out.
  const std::string alone = file("graph_parts_that_are_fixed/fixed_alone.g2o");
  expect_usage_error("optimize " + alone + " -o no.g2o", "--components optimizes each separately");
  EXPECT_NEAR(optimize(alone, "--components")["chi2_log"].get<double>(), 4.446071, 2e-6);
}

TEST_F(FieldGraphs, ACommonFactorOfFewLoopsChangesNothing) {
  PLACEGRAPH_CASE_OR_SKIP("graph_few_loops_common_factor");
  const std::vector<std::pair<int, int>> false_loops = {{2, 14}, {5, 16}, {8, 18}};
  for (const char* method : {"auto", "gnc", "pcm"}) {
    const std::string options = std::string("--robust ") + method;
    const json as_measured =
        optimize(file("graph_few_loops_common_factor/as_measured.g2o"), options);
    EXPECT_NEAR(as_measured["chi2_log"].get<double>(), 4.446071, 1e-5) << method;
    EXPECT_EQ(rejected(as_measured), false_loops) << method;
    const json less = optimize(file("graph_few_loops_common_factor/times_0.01.g2o"), options);
    EXPECT_NEAR(less["chi2_log"].get<double>(), 0.04446071, 1e-7) << method;
    EXPECT_EQ(rejected(less), false_loops) << method;
  }
}

TEST_F(FieldGraphs, FewLoopsAreJudgedAtAnyScaleOfTheNoise) {
  const std::vector<std::pair<int, int>> false_loops = {{3, 24}, {12, 35}};
  for (const double factor : {1e-4, 1.0, 1e4}) {
    test::write_file(
        dir / "square.g2o",
        noisy_square(factor, {{0, 40}, {1, 39}, {2, 38}, {5, 36}, {8, 32}, {10, 30}}, false_loops));
    const json report = optimize("square.g2o", "--robust auto");
    EXPECT_EQ(rejected(report), false_loops) << factor;
    EXPECT_TRUE(report["loops_judged"].get<bool>());
  }
}

TEST_F(FieldGraphs, TooFewLoopsAreNotJudgedAndThatIsSaid) {
  for (const double factor : {1e-4, 1.0, 1e4}) {
    test::write_file(dir / "square.g2o", noisy_square(factor, {{0, 40}}, {{3, 24}}));
    const json report = optimize("square.g2o", "--robust auto");
    EXPECT_THAT(rejected(report), IsEmpty());
    EXPECT_FALSE(report["loops_judged"].get<bool>());
    EXPECT_THAT(printed, HasSubstr("too few loops agree to know the noise's scale"));
  }
  // Without any there is nothing to judge.
  test::write_file(dir / "chain.g2o", noisy_square(1, {}, {}));
  EXPECT_TRUE(optimize("chain.g2o", "--robust auto")["loops_judged"].get<bool>());
  EXPECT_THAT(printed, IsEmpty());
}

/// A square of four poses and a fifth that hangs on the last by one edge with this information.
std::string square_with_tail(const std::string& information) {
  const std::string good = " 100 0 0 100 0 400\n";
  return "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 1.57\nVERTEX_SE2 2 1 1 3.14\nVERTEX_SE2 3 0 1 "
         "-1.57\nVERTEX_SE2 7 0 0.5 -1.57\n"
         "EDGE_SE2 0 1 1 0 1.5707963" +
         good + "EDGE_SE2 1 2 1 0 1.5707963" + good + "EDGE_SE2 2 3 1 0 1.5707963" + good +
         "EDGE_SE2 3 0 1 0.02 1.5707963" + good + "EDGE_SE2 3 7 0.5 0 0 " + information + "\n";
}

TEST_F(FieldGraphs, AMinimumThatIsNotUniqueIsReportedFromEveryStart) {
  PLACEGRAPH_CASE_OR_SKIP("graph_lower_triangle_information");
  for (const char* options : {"--initialization file", "--initialization certified",
                              "--engine ceres", "--incremental", "--robust huber"}) {
    const json report = optimize(file("graph_lower_triangle_information/lower.g2o"), options);
    EXPECT_EQ(report["free_directions"], 57 - 42) << options;
    EXPECT_EQ(report["free_vertices"].size(), 19u) << options;
    EXPECT_THAT(printed, HasSubstr("the minimum is not unique")) << options;
  }
}

TEST_F(FieldGraphs, FreeDirectionsAreReportedWithTheirVertices) {
  // Its place across is not measured.
  test::write_file(dir / "tail.g2o", square_with_tail("100 0 0 0 0 400"));
  json report = optimize("tail.g2o");
  EXPECT_EQ(report["free_directions"], 1);
  EXPECT_EQ(report["free_vertices"], json({7}));
  EXPECT_THAT(printed, HasSubstr("1 directions free, at 1 vertices (7)"));
  // Nor its direction.
  test::write_file(dir / "tail.g2o", square_with_tail("100 0 0 0 0 0"));
  EXPECT_EQ(optimize("tail.g2o")["free_directions"], 2);
  test::write_file(dir / "tail.g2o", square_with_tail("100 0 0 1e-3 0 400"));
  report = optimize("tail.g2o");
  EXPECT_EQ(report["free_directions"], 0);
  EXPECT_THAT(printed, IsEmpty());
}

TEST_F(FieldGraphs, InformationIsSemiDefiniteWithinItsPrintedDigits) {
  // Of rank one in the plane, printed with six digits: the smaller eigenvalue is -1e-4.
  test::write_file(dir / "tail.g2o", square_with_tail("100.003 57.7368 0 33.3340 0 400"));
  EXPECT_EQ(optimize("tail.g2o")["free_directions"], 1);
  test::write_file(dir / "tail.g2o", square_with_tail("1.00003e2 5.77368e1 0 3.33340e1 0 4e2"));
  EXPECT_EQ(optimize("tail.g2o")["free_directions"], 1);
  // What is farther off, or exact, is refused.
  test::write_file(dir / "tail.g2o", square_with_tail("100.003 58.7368 0 33.3340 0 400"));
  expect_usage_error("optimize tail.g2o -o no.g2o", "tail.g2o:10: the information is indefinite");
  test::write_file(dir / "tail.g2o", square_with_tail("1 2 0 1 0 400"));
  expect_usage_error("optimize tail.g2o -o no.g2o", "tail.g2o:10: the information is indefinite");
}

/// Three poses of the plane with something behind the numbers of their lines.
std::string three_poses(const std::array<const char*, 3>& behind) {
  std::string text;
  for (int i = 0; i < 3; ++i)
    text += "VERTEX_SE2 " + std::to_string(i) + " " + std::to_string(i) + " 0 0" + behind[i] + "\n";
  return text + "EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\nEDGE_SE2 1 2 1.1 0 0 1 0 0 1 0 1\n";
}

TEST_F(FieldGraphs, WordsBehindTheNumbersAreNoPartOfThem) {
  PLACEGRAPH_CASE_OR_SKIP("graph_words_behind_the_numbers");
  const std::string folder = "graph_words_behind_the_numbers/";
  EXPECT_NEAR(optimize(file(folder + "comment.g2o"))["chi2_log"].get<double>(), 4.446071, 1e-5);
  EXPECT_NEAR(optimize(file(folder + "stamps.g2o"))["chi2_log"].get<double>(), 4.446071, 1e-5);
  EXPECT_THAT(printed, HasSubstr("20 vertices have one more number after the pose"));
}

TEST_F(FieldGraphs, TimeStampsBehindVerticesArePassedOverAndThatIsSaid) {
  test::write_file(dir / "stamps.g2o", three_poses({" 1403.5", " 1403.6", " 1403.7"}));
  optimize("stamps.g2o");
  EXPECT_THAT(printed, HasSubstr("3 vertices have one more number"));
  EXPECT_THAT(run("graph convert stamps.g2o plain.g2o").err, HasSubstr("was skipped"));
  optimize("plain.g2o");
  EXPECT_THAT(printed, IsEmpty());
  // Where it may be a part of the pose it is refused, and where nobody would say so.
  const auto refuses = [&](const std::string& text, const char* message) {
    test::write_file(dir / "odd.g2o", text);
    expect_usage_error("optimize odd.g2o -o no.g2o", message);
  };
  refuses(three_poses({" 0", " 0", " 0"}), "odd.g2o:2: VERTEX_SE2: expected 4 numbers, found 5");
  refuses(three_poses({"", "", " 7"}), "odd.g2o:3: VERTEX_SE2: expected 4 numbers, found 5");
  refuses(three_poses({" 1", " 2", ""}), "odd.g2o:3: VERTEX_SE2: expected 5 numbers, found 4");
  refuses(three_poses({" 1", " 2", " x"}), "odd.g2o:3: VERTEX_SE2: expected 4 numbers, found 5");
  refuses(three_poses({" 1 1", " 2 2", " 3 3"}), "odd.g2o:1: VERTEX_SE2: expected 4 numbers");
  refuses(three_poses({"", "", ""}) + "EDGE_SE2 0 2 2 0 0 1 0 0 1 0 1 5\n",
          "odd.g2o:6: EDGE_SE2: expected 11 numbers, found 12");
  expect_usage_error("synth graph stamps.g2o -o no.g2o --shuffle",
                     "stamps.g2o:1: a number too many for a vertex");
}

}  // namespace field_graph_test
}  // namespace placegraph
