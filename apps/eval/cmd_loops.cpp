#include "apps/eval/cmd_loops.h"

#include <CLI/CLI.hpp>
#include <map>
#include <memory>

#include "apps/eval/loops.h"
#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

const std::map<std::string, LoopFileFormat> kFormats = {{"scores", LoopFileFormat::kScores},
                                                        {"ibow", LoopFileFormat::kIbow},
                                                        {"run", LoopFileFormat::kRun}};

}  // namespace

void add_loops_command(CLI::App& app) {
  auto arguments = std::make_shared<LoopsArguments>();
  auto json = std::make_shared<bool>(false);
  LoopsArguments& a = *arguments;
  CLI::App* command = app.add_subcommand(
      "loops", "Judge what place recognizers found: precision, recall, the curve between them");
  command->footer("placegraph loops --predictions found.txt --format scores --gt gt.txt --json");
  command->add_option("--predictions", a.predictions, "what a system found; several are compared")
      ->required()
      ->check(CLI::ExistingFile);
  command
      ->add_option("--format", a.formats,
                   "scores (query candidate score [stage] a line), ibow (iBoW-LCD's output, "
                   "inliers as score) or run (loops.csv of a run, its probabilities); one for all "
                   "or one each")
      ->transform(CLI::CheckedTransformer(kFormats))
      ->default_str("scores");
  command->add_option("--names", a.names, "of the systems, else the names of their files");
  command
      ->add_option("--gt", a.gt,
                   "ground truth: lines `q first last matches...`, lines `q matches...`, or a "
                   "matrix of 0 and 1")
      ->check(CLI::ExistingFile);
  command->add_option("--poses", a.poses, "ground truth: one true pose per image")
      ->check(CLI::ExistingFile);
  command->add_option("--radius", a.revisit.same.radius_m, "with --poses: largest distance [m]")
      ->capture_default_str();
  command->add_option("--heading", a.revisit.same.heading_deg, "with --poses: largest angle [deg]")
      ->capture_default_str();
  command
      ->add_option("--min-age", a.min_age,
                   "images by which a candidate must be older, hit or miss; 300, but 0 where the "
                   "truth names the candidates")
      ->check(CLI::Range(0, 1'000'000'000));
  command
      ->add_option("--tolerance", a.tolerance, "images by which a candidate may miss a true match")
      ->check(CLI::Range(0, 1'000'000))
      ->capture_default_str();
  command->add_flag("--json", *json, "print JSON");
  command->add_option("--log", a.log, "write every query's verdict as CSV");
  command->add_option("--plot", a.plot, "draw precision over recall (.png or .svg)");
  command->add_flag("--force", a.force, "overwrite files");
  command->callback([arguments, json] {
    const LoopsResult result = loops(*arguments);
    print(*json ? to_json(result) : to_text(result));
  });
}

}  // namespace placegraph::apps
