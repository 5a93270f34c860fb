#include "apps/places/cmd_match.h"

#include <placegraph/frontend/places/cues/place_cue_options.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/places/match.h"
#include "apps/support/option_texts.h"
#include "apps/support/output.h"

namespace placegraph::apps {

void add_match_command(CLI::App& places) {
  auto arguments = std::make_shared<MatchArguments>();
  MatchArguments& a = *arguments;
  CLI::App* command = places.add_subcommand(
      "match", "Find for each image an older one of the same place (short: match)");
  command->footer("placegraph places match places/corridor --out found.txt --sequence");
  command
      ->add_option(
          "DIR", a.folder,
          "a folder of images, or one with them in images/ or image_0/; gt.txt there names "
          "the candidates of each query")
      ->required()
      ->check(CLI::ExistingDirectory);
  command->add_option("-o,--out", a.out, "file for `query candidate score`, one line per query")
      ->type_name(kOutput)
      ->required();
  command->add_flag("--sequence", a.sequence, kSequenceText);
  command
      ->add_option("--min-age", a.min_age,
                   "smallest age of a candidate, in images; default: 300, or as gt.txt says")
      ->check(CLI::Range(1, 1'000'000'000));
  command->add_option("--recognizer", a.recognizer, kRecognizerText);
  command->add_option("--appearance", a.cues, kAppearanceText)
      ->delimiter(',')
      ->check(CLI::IsMember(place_cue_names()))
      ->default_str("all");
  command
      ->add_option("--codes", a.codes,
                   "descriptors to compare: appearance features, or visual words as bag (binary, "
                   "SIFT), LLC, or LLC of landmarks")
      ->check(CLI::IsMember(match_codes()))
      ->capture_default_str();
  command
      ->add_option("--vocabulary", a.vocabulary,
                   "vocabulary made by `train vocabulary`; bow learns its own without one")
      ->check(CLI::ExistingFile);
  command->add_option("--set", a.settings, kSetText)->type_size(1)->allow_extra_args(false);
  command->add_flag("--force", a.force, kForceText);
  command->callback([arguments] { print(to_text(match(*arguments))); });
}

}  // namespace placegraph::apps
