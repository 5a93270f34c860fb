// How the cost of pose-graph optimization grows with the graph: grid worlds, each solved in a
// process of its own, so that its peak memory is its own too.
//   bench_graph_growth OUT.png|OUT.svg [POSES...]        (default 1000 3000 10000 30000 100000)
#include <placegraph/backend/internal/solver/normal_equations.h>
#include <placegraph/backend/pose_graph/pose_graph_optimizer.h>
#include <placegraph/eval/internal/drawing/picture_bytes.h>
#include <placegraph/eval/internal/plots/growth_plot.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/internal/synthetic/graphs/graph_world.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>

namespace {

using namespace placegraph;

constexpr double kMega = 1048576;

/// Of one size; `graph_mb` is the peak before solving.
struct Cost {
  double poses = 0, edges = 0, iterations = 0, cpu_s = 0, graph_mb = 0, peak_mb = 0, factor_mb = 0,
         chi2 = 0;
};

double peak_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

Cost measure(int poses) {
  synthetic::GridWorldOptions world;
  world.poses = poses;
  PoseGraph graph = synthetic::make_grid_world(world);
  Cost cost;
  cost.poses = static_cast<double>(graph.nodes.size());
  cost.edges = static_cast<double>(graph.constraints.size());
  cost.graph_mb = peak_mb();
  const std::clock_t begin = std::clock();
  const PoseGraphReport report = optimize_pose_graph(std::move(graph), {});
  cost.cpu_s = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  cost.peak_mb = peak_mb();
  if (!report.outcome) throw ArgumentError(report.outcome.reason);
  cost.iterations = report.iterations;
  cost.chi2 = report.chi2_final;
  // After the peak was read: the factor again, for its size.
  NormalEquations<SE3> equations(pack<SE3>(report.graph));
  cost.factor_mb = equations.matrix().factor_size() * sizeof(double) / kMega;
  return cost;
}

/// In a process of its own; its answer comes through a pipe.
Cost measure_apart(int poses) {
  int ends[2];
  require(pipe(ends) == 0, "no pipe");
  std::fflush(stdout);
  const pid_t child = fork();
  require(child >= 0, "no process");
  if (child == 0) {
    int status = 1;
    try {
      const Cost cost = measure(poses);
      status = write(ends[1], &cost, sizeof cost) == sizeof cost ? 0 : 1;
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%d poses: %s\n", poses, error.what());
    }
    _exit(status);
  }
  close(ends[1]);
  Cost cost;
  const bool complete = read(ends[0], &cost, sizeof cost) == sizeof cost;
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  require(complete && status == 0, std::to_string(poses) + " poses: no answer");
  return cost;
}

GrowthPlot plot_of(const std::vector<Cost>& costs) {
  GrowthCurve cpu{"whole solve", {}, {}}, peak{"process at its peak", {}, {}},
      factor{"factor", {}, {}};
  for (const Cost& cost : costs) {
    for (GrowthCurve* curve : {&cpu, &peak, &factor}) curve->sizes.push_back(cost.poses);
    cpu.values.push_back(cost.cpu_s);
    peak.values.push_back(cost.peak_mb);
    factor.values.push_back(cost.factor_mb);
  }
  return {"Pose graphs of grid worlds in space, from their odometry",
          "poses",
          {{"CPU [s]", {cpu}}, {"memory [MiB]", {factor, peak}}}};
}

int run(int argc, char** argv) {
  require(argc >= 2, "bench_graph_growth OUT.png|OUT.svg [POSES...]");
  const std::string out = argv[1];
  std::vector<int> sizes;
  for (int i = 2; i < argc; ++i) sizes.push_back(std::atoi(argv[i]));
  if (sizes.empty()) sizes = {1000, 3000, 10000, 30000, 100000};
  std::printf(
      "| poses | edges | iterations | CPU s | graph MiB | peak MiB | factor MiB | chi2 |\n");
  std::printf("|---|---|---|---|---|---|---|---|\n");
  std::vector<Cost> costs;
  for (const int size : sizes) {
    const Cost c = costs.emplace_back(measure_apart(size));
    std::printf("| %.0f | %.0f | %.0f | %.3f | %.0f | %.0f | %.1f | %.6g |\n", c.poses, c.edges,
                c.iterations, c.cpu_s, c.graph_mb, c.peak_mb, c.factor_mb, c.chi2);
    std::fflush(stdout);
  }
  const GrowthPlot plot = plot_of(costs);
  std::ofstream(out, std::ios::binary) << picture_bytes(to_svg(plot), out);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_graph_growth: %s\n", error.what());
    return 2;
  }
}
