#include "apps/synth/cmd_synth_graph.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/support/option_texts.h"
#include "apps/support/output.h"
#include "apps/synth/synth_graph.h"

namespace placegraph::apps {

void add_synth_graph_command(CLI::App& synth_group) {
  auto arguments = std::make_shared<SynthGraphArguments>();
  SynthGraphArguments& a = *arguments;
  CLI::App* command = synth_group.add_subcommand(
      "graph", "Make a pose graph whose initial poses are drifted odometry");
  command->footer("placegraph synth graph manhattan-walk --poses 20000 -o walk.g2o");
  command
      ->add_option(
          "WORLD", a.world,
          "manhattan-walk (2D), grid-world (3D), long-loop, or the file of a graph that is to be "
          "made harder")
      ->type_name(kInputFile)
      ->required();
  command
      ->add_option("-o,--out", a.out, "file for the graph, in g2o format")
      ->type_name(kOutput)
      ->required();
  command->add_option("--poses", a.poses, "number of poses")->check(CLI::Range(2, 1000000));
  command
      ->add_option("--loop-share", a.loop_share,
                   "manhattan-walk, grid-world: share of possible loops that are made")
      ->check(CLI::Range(0.0, 1.0));
  command->add_option("--closures", a.closures, "long-loop: number of loops")
      ->check(CLI::Range(1, 1000000));
  command->add_option("--laps", a.laps, "long-loop: number of laps")->check(CLI::Range(1e-6, 1e6));
  command->add_flag("--3d", a.spatial, "long-loop: three-dimensional");
  command
      ->add_option("--translation-noise", a.translation_noise_m,
                   "standard deviation of a translation [m]")
      ->check(CLI::Range(1e-9, 1e9));
  command
      ->add_option("--rotation-noise", a.rotation_noise_rad,
                   "standard deviation of a rotation, also added to the odometry of a file [rad]")
      ->check(CLI::Range(1e-9, 1e9));
  command
      ->add_option("--false-loops", a.false_loops,
                   "number of false loops to add, between distant poses")
      ->check(CLI::Range(0, 1000000));
  command->add_flag("--shuffle", a.shuffle, "write the constraints in a random order");
  command->add_option("--seed", a.seed, kSeedText)->capture_default_str();
  command->add_flag("--force", a.force, kForceText);
  command->callback([arguments] { print(to_text(synth_graph(*arguments))); });
}

}  // namespace placegraph::apps
