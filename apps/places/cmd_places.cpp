#include "apps/places/cmd_places.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/places/classify_places.h"
#include "apps/support/output.h"

namespace placegraph::apps {

void add_places_command(CLI::App& app) {
  CLI::App* places = app.add_subcommand("places", "Labelled places");
  places->footer("placegraph places classify house --out told.txt");
  places->require_subcommand(1);
  auto arguments = std::make_shared<ClassifyPlacesArguments>();
  ClassifyPlacesArguments& a = *arguments;
  CLI::App* command = places->add_subcommand(
      "classify", "Learn the labels of some images and tell those of the others");
  command->footer("placegraph places classify house --out told.txt --sequence");
  command
      ->add_option("DIR", a.folder,
                   "a folder with images/, labels.txt (`image label` a line) and gt.txt, whose "
                   "candidates are learned and whose queries are told")
      ->required()
      ->check(CLI::ExistingDirectory);
  command->add_option("--out", a.out, "write `image label probability`, label -1 where refused")
      ->required();
  command
      ->add_option("--train", a.train,
                   "learn the first so many images and tell the others, whatever "
                   "gt.txt says")
      ->check(CLI::Range(2, 1'000'000'000));
  command->add_option("--reject", a.reject, "refuse to tell below this probability")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command
      ->add_option("--max-entropy", a.max_entropy,
                   "refuse to tell above this entropy, as a share of that of knowing nothing")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command->add_option("--classifier", a.classifier, "what learns the places")
      ->check(CLI::IsMember(place_machines()))
      ->capture_default_str();
  command->add_option("--cues", a.cues, "colours, quarters, edges, tiny, gabor: those that count")
      ->delimiter(',')
      ->check(CLI::IsMember(place_cues()))
      ->default_str("all");
  command->add_flag("--sequence", a.sequence, "add the evidence of the images before each");
  command->add_flag("--force", a.force, "overwrite files");
  command->callback([arguments] { print(to_text(classify_places(*arguments))); });
}

}  // namespace placegraph::apps
