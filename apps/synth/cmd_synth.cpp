#include "apps/synth/cmd_synth.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/support/output.h"
#include "apps/synth/synth.h"

namespace placegraph::apps {

void add_synth_command(CLI::App& app) {
  auto arguments = std::make_shared<SynthArguments>();
  SynthArguments& a = *arguments;
  CLI::App* command = app.add_subcommand("synth", "Render a sequence with exact ground truth");
  command->footer("placegraph synth town-loop --out out/town-loop --difficulty standard");
  command
      ->add_option(
          "WORLD", a.world.world,
          "town-loop, repeated-blocks, corridor-loop, warehouse, hover, or a KITTI pose file")
      ->required();
  command->add_option("--out", a.out, "folder to write, in KITTI's layout; hover in EuRoC's")
      ->required();
  command->add_option("--difficulty", a.difficulty, "clean, standard or hard")
      ->capture_default_str();
  command->add_option("--frames", a.world.frames, "at most this many; 0 = all")
      ->capture_default_str();
  command->add_option("--duration", a.world.duration_s, "hover: seconds of flight; 0 = 120")
      ->capture_default_str();
  auto* stereo = command->add_flag("--stereo", a.stereo, "both eyes (default outdoors)");
  command->add_flag("--mono", a.mono, "the left eye only")->excludes(stereo);
  command->add_flag("--depth", a.depth, "depth_0 (always written indoors)");
  command->add_flag("--labels", a.labels, "class and plane of every pixel");
  command->add_flag("--flow", a.flow, "exact optical flow to the next frame");
  command->add_option("--seed", a.world.seed, "another seed, another town, another flight")
      ->capture_default_str();
  command->add_option("--threads", a.threads, "frames at a time; 0 = all processors")
      ->capture_default_str();
  command->add_option("--size", a.size, "image size, as in 1241x376");
  command->add_flag("--force", a.force, "replace what is in the folder");
  command->callback([arguments] { print(to_text(synth(*arguments))); });
}

}  // namespace placegraph::apps
