#include "apps/graph/cmd_convert.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/graph/convert.h"
#include "apps/support/option_texts.h"
#include "apps/support/output.h"

namespace placegraph::apps {

void add_convert_command(CLI::App& graph) {
  auto arguments = std::make_shared<ConvertArguments>();
  ConvertArguments& a = *arguments;
  CLI::App* command =
      graph.add_subcommand("convert",
                           "Convert trajectories between KITTI, TUM and EuRoC form; "
                           "pose graphs to g2o's, or to their poses");
  command->footer("placegraph graph convert poses.txt poses.tum --times times.txt");
  command->add_option("IN", a.in, "file to read; its form is detected from its content")
      ->required()
      ->check(CLI::ExistingFile);
  command
      ->add_option("OUT", a.out, "file to write (.kitti .txt: KITTI, .tum, .csv: EuRoC, .g2o)")
      ->type_name(kOutput)
      ->required();
  command->add_option("--to", a.to, "form of OUT; default: according to its extension")
      ->check(CLI::IsMember({"kitti", "tum", "euroc", "g2o"}));
  command->add_option("--times", a.times, kTimesText)->check(CLI::ExistingFile);
  command->add_flag("--rigid", a.rigid,
                    "convert similarities to SE(3) poses, for programs without similarities");
  command->add_flag("--posed-only", a.posed_only,
                    "leave out frames without a pose, for programs that end at `nan`");
  command
      ->add_option("--posed-in", a.posed_in,
                   "also leave out frames without a pose in this trajectory of as many frames, "
                   "so that the truth and the estimate keep corresponding lines")
      ->check(CLI::ExistingFile);
  command->add_option("--apply", a.apply,
                      kApplyText);
  command
      ->add_option("--merge", a.merge,
                   "trajectories of other times to join to IN, separated by commas")
      ->delimiter(',')
      ->expected(1)
      ->take_all()
      ->check(CLI::ExistingFile);
  command->add_flag("--overlap", a.overlap,
                    "of joined trajectories that overlap in time keep the one that begins first");
  command->add_option("--split", a.split,
                      "write parts, to files OUT_1, OUT_2, ...: `gaps` divides where poses are "
                      "missing, a length of time as 60s into parts of it");
  command->add_flag("--force", a.force, kForceText);
  command->callback([arguments] { print(to_text(convert(*arguments))); });
}

}  // namespace placegraph::apps
