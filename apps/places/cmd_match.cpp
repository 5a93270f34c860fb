#include "apps/places/cmd_match.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/places/match.h"
#include "apps/support/output.h"

namespace placegraph::apps {

void add_match_command(CLI::App& app) {
  auto arguments = std::make_shared<MatchArguments>();
  MatchArguments& a = *arguments;
  CLI::App* command =
      app.add_subcommand("match", "Find for each image the older one that shows the same place");
  command->footer("placegraph match places/corridor --out found.txt --sequence");
  command
      ->add_option(
          "DIR", a.folder,
          "a folder of images, or one with them in images/ or image_0/; gt.txt there names "
          "the candidates of each query")
      ->required()
      ->check(CLI::ExistingDirectory);
  command->add_option("--out", a.out, "write `query candidate score`, one line per query")
      ->required();
  command->add_flag("--sequence", a.sequence, "add the evidence of the images before each query");
  command
      ->add_option("--min-age", a.min_age,
                   "compare every image with those at least so many older, whatever gt.txt says; "
                   "300 without one")
      ->check(CLI::Range(1, 1'000'000'000));
  command->add_option("--cues", a.cues, "tiny, colour, gradients, gabor, corners: those that count")
      ->delimiter(',')
      ->check(CLI::IsMember(match_cues()))
      ->default_str("all");
  command
      ->add_option("--codes", a.codes,
                   "what is compared: all cues, or visual words as bag (binary, SIFT), LLC, or "
                   "LLC of landmarks")
      ->check(CLI::IsMember(match_codes()))
      ->capture_default_str();
  command
      ->add_option("--vocabulary", a.vocabulary,
                   "words made by `vocabulary train`; bow learns its own without one")
      ->check(CLI::ExistingFile);
  command->add_option("--set", a.settings, "one option, key=value; may be repeated")
      ->type_size(1)
      ->allow_extra_args(false);
  command->add_flag("--force", a.force, "overwrite files");
  command->callback([arguments] { print(to_text(match(*arguments))); });
}

}  // namespace placegraph::apps
