#include "apps/synth/cmd_synth.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/config/yaml_config.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>

#include "apps/support/option_texts.h"
#include "apps/support/output.h"
#include "apps/synth/synth.h"

namespace placegraph::apps {
namespace {

/// `--defects` and one flag for each defect, which overrides the set.
void add_defect_flags(CLI::App& command, SyntheticDefects& defects) {
  const char* const kGroup = "Defects";
  // Flags take effect in the order in which they are added here: first the set.
  command
      .add_option_function<std::string>(
          "--defects", [&defects](const std::string& name) { defects = defects_from(name); },
          "set of defects: none, hard-drive or hard-rgbd")
      ->group(kGroup);
  for (const OptionEntry& entry : list_options(SyntheticDefects())) {
    std::string flag = "--" + entry.path;
    std::replace(flag.begin(), flag.end(), '_', '-');
    command
        .add_option_function<double>(
            flag,
            [&defects, flag, key = entry.path](double value) {
              require(std::isfinite(value), flag + ": is not a number");
              set_option(defects, fmt::format("{}={}", key, value));
            },
            entry.doc)
        ->check(CLI::Range(entry.range.min, entry.range.max))
        ->group(kGroup);
  }
}

}  // namespace

void add_synth_sequence_command(CLI::App& synth_group) {
  auto arguments = std::make_shared<SynthArguments>();
  SynthArguments& a = *arguments;
  CLI::App* command =
      synth_group.add_subcommand("sequence", "Render a sequence with exact ground truth");
  command->footer("placegraph synth sequence town-loop --out out/town-loop --difficulty standard");
  command
      ->add_option(
          "WORLD", a.world.world,
          "town-loop, repeated-blocks, corridor-loop, warehouse, turning-walk, flight, or a KITTI "
          "pose file")
      ->required();
  command
      ->add_option("-o,--out", a.out,
                   "folder for the sequence, in KITTI's layout; a flight in EuRoC's")
      ->type_name(kOutput)
      ->required();
  command->add_option("--difficulty", a.difficulty, "difficulty: clean, standard or hard")
      ->capture_default_str();
  command->add_option("--frames", a.world.frames, "largest number of frames; 0 = all")
      ->capture_default_str();
  command->add_option("--duration", a.world.duration_s, "flight: duration [s]; 0 = 120")
      ->capture_default_str();
  auto* stereo =
      command->add_flag("--stereo", a.stereo, "left and right camera (default outdoors)");
  command->add_flag("--mono", a.mono, "left camera only")->excludes(stereo);
  command->add_flag("--depth", a.depth, "write depth images (always written indoors)");
  command->add_flag("--labels", a.labels, "write class and plane of every pixel");
  command->add_flag("--flow", a.flow, "write the exact optical flow to the next frame");
  command->add_option("--seed", a.world.seed, kSeedText)->capture_default_str();
  command->add_option("--threads", a.threads, kThreadsText)->capture_default_str();
  command->add_option("--size", a.size, "image size, as in 1241x376");
  command->add_flag("--force", a.force, kForceText);
  add_defect_flags(*command, a.world.defects);
  command->callback([arguments] { print(to_text(synth(*arguments))); });
}

}  // namespace placegraph::apps
