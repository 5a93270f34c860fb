#include "apps/synth/synth_graph.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/graphs/g2o.h>
#include <placegraph/io/graphs/pose_graph_file.h>
#include <placegraph/io/synthetic/graphs/graph_world.h>

#include <filesystem>

#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

/// The options that all worlds share.
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
  require(
      std::filesystem::exists(arguments.world),
      arguments.world + ": neither manhattan-walk, grid-world nor long-loop, nor an existing file");
  refuse_foreign(arguments, false, false);
  require(!arguments.poses && !arguments.translation_noise_m,
          "--poses and --translation-noise are no options of a file");
  require(
      arguments.rotation_noise_rad || arguments.false_loops > 0 || arguments.shuffle,
      arguments.world + ": a graph file needs one of --rotation-noise, --false-loops or --shuffle");
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

}  // namespace

SynthGraphResult synth_graph(const SynthGraphArguments& arguments) {
  require_free(arguments.out, arguments.force);
  PoseGraph graph = make_graph(arguments);
  synthetic::add_false_loops(graph, arguments.false_loops, arguments.seed);
  if (arguments.shuffle) synthetic::shuffle_constraints(graph, arguments.seed);
  write_g2o(arguments.out, graph);
  return {arguments.world, arguments.out, graph.nodes.size(), graph.constraints.size()};
}

std::string to_text(const SynthGraphResult& result) {
  return fmt::format("{}: {} poses, {} constraints, written to {}\n", result.world, result.poses,
                     result.constraints, result.out);
}

}  // namespace placegraph::apps
