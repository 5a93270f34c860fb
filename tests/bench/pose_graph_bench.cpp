// Kernels of pose-graph optimization: assembly of the normal equations, factorization, solution,
// and whole solves with both engines. Grid worlds are drawn; files of the research data are added
// where they are.
#include <benchmark/benchmark.h>
#include <placegraph/backend/pose_graph/pose_graph_optimizer.h>
#include <placegraph/backend/solver/normal_equations.h>
#include <placegraph/io/graphs/g2o.h>
#include <placegraph/io/synthetic/graphs/graph_world.h>

#include "tests/support/data.h"

namespace {

using namespace placegraph;

constexpr const char* kFiles[] = {"intel", "M3500", "city10000", "sphere2500", "torus3D"};

PoseGraph grid_world(int poses) {
  synthetic::GridWorldOptions options;
  options.poses = poses;
  return synthetic::make_grid_world(options);
}

/// The packed graph and its equations at the start.
template <class Group>
struct System {
  PackedGraph<Group> graph;
  NormalEquations<Group> equations;
  explicit System(const PoseGraph& unpacked) : graph(pack<Group>(unpacked)), equations(graph) {
    equations.linearize(graph, RotationError::kLog);
  }
};

template <class Group>
void assemble(benchmark::State& state, const PoseGraph& graph) {
  System<Group> system(graph);
  for (auto _ : state)
    benchmark::DoNotOptimize(system.equations.linearize(system.graph, RotationError::kLog));
  state.counters["edges"] = static_cast<double>(system.graph.edges.size());
}

template <class Group>
void analyze(benchmark::State& state, const PoseGraph& graph) {
  const PackedGraph<Group> packed = pack<Group>(graph);
  for (auto _ : state) benchmark::DoNotOptimize(NormalEquations<Group>(packed));
}

template <class Group>
void factorize(benchmark::State& state, const PoseGraph& graph) {
  System<Group> system(graph);
  for (auto _ : state)
    if (!system.equations.matrix().factorize()) state.SkipWithError("not positive definite");
  state.counters["factor_mb"] = system.equations.matrix().factor_size() * 8 / 1048576;
}

template <class Group>
void back_substitute(benchmark::State& state, const PoseGraph& graph) {
  System<Group> system(graph);
  if (!system.equations.matrix().factorize()) return state.SkipWithError("not positive definite");
  Eigen::VectorXd x;
  for (auto _ : state) {
    x = system.equations.gradient();
    system.equations.matrix().solve(x);
    benchmark::DoNotOptimize(x.data());
  }
}

void solve(benchmark::State& state, const PoseGraph& graph, PoseGraphEngine engine) {
  PoseGraphOptions options;
  options.engine = engine;
  for (auto _ : state) {
    state.PauseTiming();
    PoseGraph copy = graph;
    state.ResumeTiming();
    const PoseGraphReport report = optimize_pose_graph(std::move(copy), options);
    if (!report.outcome) state.SkipWithError(report.outcome.reason.c_str());
    state.counters["iterations"] = report.iterations;
    state.counters["chi2"] = report.chi2_final;
  }
}

void check(benchmark::State& state, const PoseGraph& graph) {
  for (auto _ : state) graph.check();
}

template <class Group>
void add_kernels(const std::string& name, const PoseGraph& graph) {
  const auto add = [&](const char* kernel, void (*run)(benchmark::State&, const PoseGraph&)) {
    benchmark::RegisterBenchmark((kernel + ("/" + name)).c_str(), [run,
                                                                   graph](benchmark::State& state) {
      run(state, graph);
    })->Unit(benchmark::kMillisecond);
  };
  add("check", check);
  add("analyze", analyze<Group>);
  add("assemble", assemble<Group>);
  add("factorize", factorize<Group>);
  add("back_substitute", back_substitute<Group>);
  add("solve_native", [](benchmark::State& state, const PoseGraph& g) {
    solve(state, g, PoseGraphEngine::kNative);
  });
  add("solve_ceres", [](benchmark::State& state, const PoseGraph& g) {
    solve(state, g, PoseGraphEngine::kCeres);
  });
}

void add_graph(const std::string& name, const PoseGraph& graph) {
  if (graph.kind() == PoseKind::kSE2)
    add_kernels<SE2>(name, graph);
  else
    add_kernels<SE3>(name, graph);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  for (const int poses : {1000, 10000})
    add_graph("grid_" + std::to_string(poses), grid_world(poses));
  for (const char* name : kFiles) {
    const std::string path = test::data_dir() + "/posegraphs/" + name + ".g2o";
    if (std::filesystem::exists(path)) add_graph(name, read_g2o(path));
  }
  benchmark::RunSpecifiedBenchmarks();
}
