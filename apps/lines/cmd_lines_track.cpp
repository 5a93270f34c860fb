#include "apps/lines/cmd_lines_track.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/lines/lines_track.h"
#include "apps/support/output.h"

namespace placegraph::apps {

void add_lines_track_command(CLI::App& lines) {
  auto arguments = std::make_shared<LinesTrackArguments>();
  auto json = std::make_shared<bool>(false);
  LinesTrackArguments& a = *arguments;
  CLI::App* command = lines.add_subcommand(
      "track", "Follow straight edges through a sequence; with true poses, count wrong ones");
  command->footer("placegraph lines track SEQUENCE -o tracks.txt");
  command->add_option("SEQUENCE", a.sequence, "data set")->required();
  command->add_option("-o,--out", a.out, "file to write, `id frame u1 v1 u2 v2` a line");
  command->add_option("--sensor", a.sensor, "what to run it as")
      ->check(CLI::IsMember({"auto", "mono", "stereo", "rgbd"}))
      ->capture_default_str();
  command->add_option("--cues", a.cues, "what the motion is seen by, lines among them")
      ->capture_default_str();
  command->add_option("--set", a.settings, "an option of the run, key=value; may be repeated")
      ->type_size(1)
      ->allow_extra_args(false);
  command->add_flag("--json", *json, "print JSON");
  command->add_flag("--force", a.force, "overwrite OUT");
  command->callback([arguments, json] {
    const LinesTrackResult result = lines_track(*arguments);
    print(*json ? to_json(result) : to_text(result));
  });
}

}  // namespace placegraph::apps
