#include "apps/eval/cmd_loops.h"

#include <CLI/CLI.hpp>
#include <map>
#include <memory>

#include "apps/eval/loops.h"
#include "apps/support/option_texts.h"
#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

const std::map<std::string, LoopFileFormat> kFormats = {{"scores", LoopFileFormat::kScores},
                                                        {"ibow", LoopFileFormat::kIbow},
                                                        {"run", LoopFileFormat::kRun},
                                                        {"topk", LoopFileFormat::kTopK},
                                                        {"matrix", LoopFileFormat::kMatrix}};
const std::vector<std::string> kFormatNames = {"scores", "ibow", "run", "topk", "matrix"};

void add_predictions(CLI::App& command, LoopsArguments& a) {
  command
      .add_option("--predictions", a.predictions, "predictions of a system; several are compared")
      ->required()
      ->check(CLI::ExistingFile);
  command
      .add_option_function<std::vector<std::string>>(
          "--format",
          [&a](const std::vector<std::string>& names) {
            a.formats.clear();
            for (const std::string& name : names) a.formats.push_back(kFormats.at(name));
          },
          "scores (query candidate score [stage] a line, with a header or without), ibow "
          "(iBoW-LCD's output, inliers as score), run (loops.csv of a run, its probabilities), topk "
          "(the best candidates of a query in a row) or matrix (the score of each pair); one for "
          "all or one each")
      ->check(CLI::IsMember(kFormatNames))
      ->default_str("scores");
  command
      .add_option_function<std::string>(
          "--scores",
          [&a](const std::string& kind) {
            a.scores = kind == "distance" ? ScoreKind::kDistance : ScoreKind::kSimilarity;
          },
          "what scores are: similarity (larger is more certain) or distance; default: as the header "
          "of their column says, else similarity")
      ->check(CLI::IsMember({"similarity", "distance"}));
  command
      .add_option("--top-k-scores", a.scores_of_top_k,
                  "with --format topk: the scores of the candidates, a file of the same shape")
      ->check(CLI::ExistingFile);
  command.add_option("--systems", a.names,
                     "names of the systems; default: the names of their files");
}

void add_truth(CLI::App& command, LoopsArguments& a) {
  command
      .add_option("--truth", a.truth,
                  "true matches: lines `q first last matches...`, lines `q matches...`, or a matrix "
                  "of 0 and 1 (text or .npy), row q and column m")
      ->check(CLI::ExistingFile);
  command
      .add_option("--true-poses", a.poses,
                  "ground truth of one drive: one true pose or position per image")
      ->check(CLI::ExistingFile);
  const char* images =
      ": poses, positions (also latitude and longitude, or in names: @ east @ north @ ...), names "
      "or a folder of images";
  command.add_option("--queries", a.queries, std::string("images that ask") + images)
      ->check(CLI::ExistingPath);
  command.add_option("--database", a.database, std::string("images that answer") + images)
      ->check(CLI::ExistingPath);
  command.add_flag("--within", a.within,
                   "candidates are older images of the queries' own drive; needed where the truth "
                   "does not say it");
  command
      .add_option("--radius", a.revisit.same.radius_m,
                   "with --true-poses: largest distance of the same place [m]")
      ->capture_default_str();
  command
      .add_option("--heading", a.revisit.same.heading_deg,
                   "with --true-poses: largest angle between views of the same place [deg]")
      ->capture_default_str();
  command
      .add_option("--min-age", a.min_age,
                   "smallest age of a candidate within one drive, in images; default: 300, or 0 if "
                   "the truth names the candidates; 0: of a database")
      ->check(CLI::Range(0, 1'000'000'000));
  command.add_option("--tolerance", a.tolerance, "largest distance from a true match, in images")
      ->check(CLI::Range(0, 1'000'000))
      ->capture_default_str();
}

}  // namespace

void add_eval_loops_command(
    CLI::App& eval_group,
    const std::function<void(const LoopsArguments&, const LoopsResult&)>& write_page) {
  auto arguments = std::make_shared<LoopsArguments>();
  auto json = std::make_shared<bool>(false);
  LoopsArguments& a = *arguments;
  CLI::App* command = eval_group.add_subcommand(
      "loops", "Evaluate loop closures by precision and recall (short: loops)");
  command->footer(
      "placegraph eval loops --predictions found.txt --format scores --truth gt.txt --json");
  add_predictions(*command, a);
  add_truth(*command, a);
  command->add_flag("--json", *json, kJsonText);
  command->add_option("--csv", a.csv, "write the details as CSV")->type_name(kOutput);
  command->add_option("--curve", a.curve, "write precision and recall at every threshold as CSV")
      ->type_name(kOutput);
  command->add_option("--plot", a.plot, kPlotText)->type_name(kOutput);
  command->add_option("--report", a.report, kReportText)->type_name(kOutput);
  command->add_flag("--force", a.force, kForceText);
  command->callback([arguments, json, write_page] {
    const LoopsResult result = loops(*arguments);
    print(*json ? to_json(result) : to_text(result));
    if (!arguments->report.empty()) write_page(*arguments, result);
  });
}

}  // namespace placegraph::apps
