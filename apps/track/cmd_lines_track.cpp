#include "apps/track/cmd_lines_track.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/support/option_texts.h"
#include "apps/support/output.h"
#include "apps/track/lines_track.h"

namespace placegraph::apps {

void add_lines_track_command(CLI::App& track) {
  auto arguments = std::make_shared<LinesTrackArguments>();
  auto json = std::make_shared<bool>(false);
  LinesTrackArguments& a = *arguments;
  CLI::App* command = track.add_subcommand(
      "lines", "Track straight edges through a sequence; true poses show wrong tracks");
  command->footer("placegraph track lines SEQUENCE -o tracks.txt");
  command
      ->add_option("SEQUENCE", a.sequence, "data set")
      ->type_name(kInput)
      ->required();
  command
      ->add_option("-o,--out", a.out, "file to write, `id frame u1 v1 u2 v2` a line")
      ->type_name(kOutput);
  command->add_option("--sensor", a.sensor, kSensorText)
      ->check(CLI::IsMember({"auto", "mono", "stereo", "rgbd"}))
      ->capture_default_str();
  command
      ->add_option("--cues", a.cues,
                   "image evidence for the motion, joined by commas; lines among them")
      ->capture_default_str();
  command->add_option("--set", a.settings, kSetText)->type_size(1)->allow_extra_args(false);
  command->add_flag("--json", *json, kJsonText);
  command->add_flag("--force", a.force, kForceText);
  command->callback([arguments, json] {
    const LinesTrackResult result = lines_track(*arguments);
    print(*json ? to_json(result) : to_text(result));
  });
}

}  // namespace placegraph::apps
