#include "apps/places/cmd_places.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/places/classify_places.h"
#include "apps/support/option_texts.h"
#include "apps/support/output.h"

namespace placegraph::apps {

void add_classify_command(CLI::App& places) {
  auto arguments = std::make_shared<ClassifyPlacesArguments>();
  ClassifyPlacesArguments& a = *arguments;
  CLI::App* command = places.add_subcommand(
      "classify", "Learn the labels of some images and predict those of the others");
  command->footer("placegraph places classify house --out labels.txt --sequence");
  command
      ->add_option("DIR", a.folder,
                   "folder with images/, labels.txt (`image label` per line) and gt.txt, whose "
                   "candidates are the training set and whose queries are classified")
      ->required()
      ->check(CLI::ExistingDirectory);
  command
      ->add_option("-o,--out", a.out, "file for `image label probability`; label -1: rejected")
      ->type_name(kOutput)
      ->required();
  command
      ->add_option("--train", a.train,
                   "number of images at the beginning that are the training set, instead of gt.txt")
      ->check(CLI::Range(2, 1'000'000'000));
  command->add_option("--reject", a.reject, "reject predictions below this probability")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command
      ->add_option("--max-entropy", a.max_entropy,
                   "reject predictions above this entropy, as a share of a uniform distribution's")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command->add_option("--classifier", a.classifier, "classifier to train")
      ->check(CLI::IsMember(place_machines()))
      ->capture_default_str();
  command->add_option("--appearance", a.cues, "appearance features to compare, joined by commas")
      ->delimiter(',')
      ->check(CLI::IsMember(place_cues()))
      ->default_str("all");
  command->add_flag("--sequence", a.sequence, kSequenceText);
  command->add_flag("--force", a.force, kForceText);
  command->callback([arguments] { print(to_text(classify_places(*arguments))); });
}

}  // namespace placegraph::apps
