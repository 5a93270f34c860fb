#include "apps/synth/cmd_synth_graph.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/graphs/g2o.h>
#include <placegraph/io/graphs/pose_graph_file.h>
#include <placegraph/io/synthetic/graphs/false_loops.h>
#include <placegraph/io/synthetic/graphs/graph_world.h>
#include <CLI/CLI.hpp>

#include <filesystem>
#include <memory>
#include <optional>

#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

struct SynthGraphArguments {
  std::string world, out;
  std::optional<int> poses, closures;
  std::optional<double> loop_share, laps, translation_noise_m, rotation_noise_rad;
  std::uint64_t seed = 1;
  int false_loops = 0;
  bool spatial = false, shuffle = false, force = false;
};

/// The options of all worlds have these in common.
template <class Options>
Options common_options(const SynthGraphArguments& arguments) {
  Options options;
  options.seed = arguments.seed;
  if (arguments.poses) options.poses = *arguments.poses;
  if (arguments.translation_noise_m) options.noise.translation_m = *arguments.translation_noise_m;
  if (arguments.rotation_noise_rad) options.noise.rotation_rad = *arguments.rotation_noise_rad;
  return options;
}

void refuse_foreign(const SynthGraphArguments& arguments, bool loop_share, bool loops) {
  const std::string where = " is no option of " + arguments.world;
  require(loop_share || !arguments.loop_share, "--loop-share" + where);
  require(loops || !arguments.closures, "--closures" + where);
  require(loops || !arguments.laps, "--laps" + where);
  require(loops || !arguments.spatial, "--3d" + where);
}

PoseGraph disturbed_file(const SynthGraphArguments& arguments) {
  require(std::filesystem::exists(arguments.world),
          arguments.world +
              ": neither manhattan-walk, grid-world nor long-loop, nor a file that is there");
  refuse_foreign(arguments, false, false);
  require(!arguments.poses && !arguments.translation_noise_m,
          "--poses and --translation-noise are no options of a file");
  require(
      arguments.rotation_noise_rad || arguments.false_loops > 0 || arguments.shuffle,
      arguments.world + ": what is to be done to it? --rotation-noise, --false-loops or --shuffle");
  PoseGraph graph = read_pose_graph(arguments.world);
  if (arguments.rotation_noise_rad)
    synthetic::add_rotation_noise(graph, *arguments.rotation_noise_rad, arguments.seed);
  return graph;
}

PoseGraph make_graph(const SynthGraphArguments& arguments) {
  if (arguments.world == "manhattan-walk") {
    refuse_foreign(arguments, true, false);
    auto options = common_options<synthetic::ManhattanWalkOptions>(arguments);
    if (arguments.loop_share) options.loop_share = *arguments.loop_share;
    return synthetic::make_manhattan_walk(options);
  }
  if (arguments.world == "grid-world") {
    refuse_foreign(arguments, true, false);
    auto options = common_options<synthetic::GridWorldOptions>(arguments);
    if (arguments.loop_share) options.loop_share = *arguments.loop_share;
    return synthetic::make_grid_world(options);
  }
  if (arguments.world == "long-loop") {
    refuse_foreign(arguments, false, true);
    auto options = common_options<synthetic::LongLoopOptions>(arguments);
    if (arguments.closures) options.closures = *arguments.closures;
    if (arguments.laps) options.laps = *arguments.laps;
    options.kind = arguments.spatial ? PoseKind::kSE3 : PoseKind::kSE2;
    return synthetic::make_long_loop(options);
  }
  return disturbed_file(arguments);
}

void run(const SynthGraphArguments& arguments) {
  require_free(arguments.out, arguments.force);
  PoseGraph graph = make_graph(arguments);
  synthetic::add_false_loops(graph, arguments.false_loops, arguments.seed);
  if (arguments.shuffle) synthetic::shuffle_constraints(graph, arguments.seed);
  write_g2o(arguments.out, graph);
  fmt::print("{}: {} poses, {} constraints, written to {}\n", arguments.world, graph.nodes.size(),
             graph.constraints.size(), arguments.out);
}

}  // namespace

void add_synth_graph_command(CLI::App& app) {
  auto arguments = std::make_shared<SynthGraphArguments>();
  SynthGraphArguments& a = *arguments;
  CLI::App* command =
      app.add_subcommand("synth-graph", "Make a pose graph that starts from drifted odometry");
  command->footer("placegraph synth-graph manhattan-walk --poses 20000 -o walk.g2o");
  command
      ->add_option(
          "WORLD", a.world,
          "manhattan-walk (2D), grid-world (3D), long-loop, or the file of a graph that is to be "
          "made harder")
      ->required();
  command->add_option("-o,--out", a.out, "graph to write, in g2o's form")->required();
  command->add_option("--poses", a.poses, "how many")->check(CLI::Range(2, 1000000));
  command
      ->add_option("--loop-share", a.loop_share,
                   "manhattan-walk, grid-world: share of the chances for a loop that become one")
      ->check(CLI::Range(0.0, 1.0));
  command->add_option("--closures", a.closures, "long-loop: how many loops")
      ->check(CLI::Range(1, 1000000));
  command->add_option("--laps", a.laps, "long-loop: how often round")->check(CLI::Range(1e-6, 1e6));
  command->add_flag("--3d", a.spatial, "long-loop: in space");
  command->add_option("--translation-noise", a.translation_noise_m, "of a measurement [m]")
      ->check(CLI::Range(1e-9, 1e9));
  command
      ->add_option("--rotation-noise", a.rotation_noise_rad,
                   "of a measurement, or added to the odometry of a file [rad]")
      ->check(CLI::Range(1e-9, 1e9));
  command
      ->add_option("--false-loops", a.false_loops,
                   "add so many behind the others, between poses that stand far apart")
      ->check(CLI::Range(0, 1000000));
  command->add_flag("--shuffle", a.shuffle, "write the constraints in a random order");
  command->add_option("--seed", a.seed, "another seed, other chances")->capture_default_str();
  command->add_flag("--force", a.force, "overwrite OUT");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace placegraph::apps
