#include <gtest/gtest.h>
#include <placegraph/backend/robust/loop_gate.h>
#include <placegraph/graph/core/chi_squared.h>

namespace placegraph {
namespace loop_gate_test {

constexpr double kProbability = 0.99;
constexpr LoopGateWidth kWidth{.margin = 1.5, .tail = 3, .nearly_right = 0.01};

/// Three poses at corners of a square of ten metres; loops from the first to the last.
PackedGraph<SE2> graph_of_loops(int loops) {
  PackedGraph<SE2> graph;
  for (const Eigen::Vector2d& p : {Eigen::Vector2d(0, 0), {10, 0}, {10, 10}})
    graph.poses.emplace_back(SO2(), p);
  PackedGraph<SE2>::Edge edge{};
  edge.from = 0, edge.to = 2;
  edge.T_to_from = graph.poses[2].inverse() * graph.poses[0];
  edge.weight = 1;
  graph.edges.assign(static_cast<std::size_t>(loops), edge);
  return graph;
}

/// A gate for noise of the variance that the information claims.
LoopGate<SE2> gate_of(const PackedGraph<SE2>& graph) { return {graph, kProbability, 1, kWidth}; }
const double kOfNoise = 1.5 * chi_squared_quantile(kProbability, 3);

TEST(LoopGate, BeginsWithTheNoiseThatIsKnown) {
  const LoopGate<SE2> gate(graph_of_loops(1), kProbability, 4, kWidth);
  EXPECT_DOUBLE_EQ(gate.noise_scale(), 4);
  EXPECT_NEAR(gate.of_noise(), 4 * kOfNoise, 1e-9);
  EXPECT_NEAR(gate.widest(), 20 * 4 * kOfNoise, 1e-8);
}

TEST(LoopGate, LearnsTheNoiseFromLoopsThatAreTaken) {
  PackedGraph<SE2> graph = graph_of_loops(4);
  graph.edges[0].odometry = true;
  graph.edges[2].weight = 0;
  LoopGate<SE2> gate = gate_of(graph);
  gate.learn(graph, {1000, 30, 500, 60});
  EXPECT_DOUBLE_EQ(gate.noise_scale(), (30 + 60) / (3.0 * 2));
  EXPECT_NEAR(gate.widest(), 20 * 15 * kOfNoise, 1e-6);
  // Good loops later do not take back what was seen.
  gate.learn(graph, {0, 1, 0, 1});
  EXPECT_DOUBLE_EQ(gate.noise_scale(), 15);
}

TEST(LoopGate, IsAsWideAsTheLongTailOfTrueLoops) {
  const PackedGraph<SE2> graph = graph_of_loops(21);
  std::vector<double> chi2(21, 0.0);
  chi2[3] = 16;  // the mean of all stays below the noise that is known
  LoopGate<SE2> gate = gate_of(graph);
  gate.learn(graph, chi2);
  EXPECT_DOUBLE_EQ(gate.noise_scale(), 1);
  EXPECT_DOUBLE_EQ(gate.widest(), 20 * 3 * 16);
}

TEST(LoopGate, IsWidenedByNoLoopBeyondIt) {
  const PackedGraph<SE2> graph = graph_of_loops(21);
  std::vector<double> chi2(21, 0.0);
  chi2[3] = 40;
  LoopGate<SE2> gate = gate_of(graph);
  gate.learn(graph, chi2);
  EXPECT_DOUBLE_EQ(gate.noise_scale(), 1);
  EXPECT_NEAR(gate.widest(), 20 * 3 * kOfNoise, 1e-8);
}

TEST(LoopGate, IsWidenedByALoopThatIsTakenWithinIt) {
  LoopGate<SE2> gate = gate_of(graph_of_loops(1));
  gate.widen(1);
  EXPECT_NEAR(gate.widest(), 20 * kOfNoise, 1e-8);
  gate.widen(16);
  EXPECT_DOUBLE_EQ(gate.widest(), 20 * 3 * 16);
  gate.widen(49);  // taken for nearly right
  EXPECT_DOUBLE_EQ(gate.widest(), 20 * 3 * 16);
}

TEST(LoopGate, IsTwentyTimesAsWideForALoopThatSaysNearlyTheRightThing) {
  PackedGraph<SE2> graph = graph_of_loops(1);
  const LoopGate<SE2> gate = gate_of(graph);
  const SE2 T_to_from = graph.edges[0].T_to_from;
  const auto of_loop_off_by = [&](double along_m, double rotation_rad) {
    graph.edges[0].T_to_from = SE2::exp({along_m, 0, rotation_rad}) * T_to_from;
    return gate.of_loop(graph, 0);
  };
  // A hundredth of the square's diagonal is 0.141 m, of half a turn 0.0314 rad.
  EXPECT_DOUBLE_EQ(of_loop_off_by(0.13, 0), gate.widest());
  EXPECT_NEAR(of_loop_off_by(0.15, 0), kOfNoise, 1e-9);
  EXPECT_DOUBLE_EQ(of_loop_off_by(0, 0.03), gate.widest());
  EXPECT_NEAR(of_loop_off_by(0, 0.033), kOfNoise, 1e-9);
}

}  // namespace loop_gate_test
}  // namespace placegraph
