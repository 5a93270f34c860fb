#include <numbers>

#include <benchmark/benchmark.h>
#include <placegraph/backend/pose_graph/pose_graph_optimizer.h>

#include "tests/support/scenes/window_world.h"

namespace {

using namespace placegraph;

test::WindowWorld world_of(const benchmark::State& state, Random& random) {
  test::WindowWorldOptions options;
  options.keyframes = static_cast<int>(state.range(0));
  options.landmarks = static_cast<int>(state.range(1));
  options.stereo = state.range(2) != 0;
  options.noise_px = 0.5;
  return make_window_world(options, random);
}

SlidingWindow window_of(const benchmark::State& state, int max_keyframes) {
  Random random(1);
  const test::WindowWorld world = world_of(state, random);
  SlidingWindowOptions options;
  options.max_keyframes = max_keyframes;
  SlidingWindow window(options, world.camera);
  fill_window(window, world, random, 0.05, 0.005, 0.3);
  if (state.range(2) == 0)
    add_distance(window, {KeyframeId(0), KeyframeId(1),
                          test::distance_m(world.T_map_cam[0], world.T_map_cam[1]), 0.01});
  return window;
}

void WindowOptimize(benchmark::State& state) {
  double iterations = 0;
  for (auto _ : state) {
    state.PauseTiming();
    SlidingWindow window = window_of(state, 20);
    state.ResumeTiming();
    const WindowSummary summary = window.optimize();
    if (!summary.outcome) state.SkipWithError(summary.outcome.reason.c_str());
    iterations = summary.iterations;
  }
  state.counters["iterations"] = iterations;
}

void WindowMarginalize(benchmark::State& state) {
  for (auto _ : state) {
    state.PauseTiming();
    SlidingWindow window = window_of(state, static_cast<int>(state.range(0)) - 1);
    state.ResumeTiming();
    benchmark::DoNotOptimize(window.marginalize());
  }
}

void WindowRelativeInformation(benchmark::State& state) {
  const SlidingWindow window = window_of(state, 20);
  for (auto _ : state)
    benchmark::DoNotOptimize(relative_information(window, state.range(0) - 2, state.range(0) - 1));
}

/// A walk on a grid in space, with loops to the row before.
void PoseGraphOptimize(benchmark::State& state) {
  Random random(2);
  const int side = 20;
  PoseGraph graph;
  std::vector<SE3> truth;
  const auto relative = [&](std::int64_t from, std::int64_t to, ConstraintSource source) {
    RelativePoseConstraint c;
    c.from = NodeId(from);
    c.to = NodeId(to);
    c.T_from_to = truth[static_cast<std::size_t>(from)].inverse() *
                  truth[static_cast<std::size_t>(to)] * test::random_motion(random, 0.02, 0.01);
    c.information = Matrix6d(Matrix6d::Identity() * 1e3);
    c.source = source;
    graph.constraints.emplace_back(c);
    return std::get<SE3>(c.T_from_to);
  };
  for (int i = 0; i < static_cast<int>(state.range(0)); ++i) {
    const int row = i / side, column = row % 2 ? side - 1 - i % side : i % side;
    truth.emplace_back(SO3::exp({0, 0, row % 2 ? std::numbers::pi : 0.0}),
                       Eigen::Vector3d(column, row, 0));
    SE3 T_world_node;
    if (i > 0)
      T_world_node = std::get<SE3>(graph.nodes.back().T_world_node) *
                     relative(i - 1, i, ConstraintSource::kOdometry);
    graph.nodes.push_back({NodeId(i), T_world_node, false});
    const int across = (row - 1) * side + (side - 1 - i % side);
    if (row > 0 && across < i - 1) relative(across, i, ConstraintSource::kLoop);
  }
  double iterations = 0;
  for (auto _ : state) iterations = optimize_pose_graph(graph, {}).iterations;
  state.counters["iterations"] = iterations;
}

BENCHMARK(WindowOptimize)
    ->Args({8, 300, 0})
    ->Args({10, 600, 0})
    ->Args({10, 600, 1})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(WindowMarginalize)->Args({10, 600, 0})->Args({10, 600, 1})->Unit(benchmark::kMillisecond);
BENCHMARK(WindowRelativeInformation)
    ->Args({10, 600, 0})
    ->Args({10, 600, 1})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(PoseGraphOptimize)->Arg(100)->Arg(1000)->Arg(10000)->Unit(benchmark::kMillisecond);

}  // namespace
