#include "apps/synth/cmd_synth_graph.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/support/output.h"
#include "apps/synth/synth_graph.h"

namespace placegraph::apps {

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
  command->callback([arguments] { print(to_text(synth_graph(*arguments))); });
}

}  // namespace placegraph::apps
