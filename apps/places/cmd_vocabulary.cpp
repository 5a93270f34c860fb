#include "apps/places/cmd_vocabulary.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/places/train_vocabulary.h"
#include "apps/places/vocabulary_info.h"
#include "apps/support/option_texts.h"
#include "apps/support/output.h"

namespace placegraph::apps {

void add_train_vocabulary_command(CLI::App& train) {
  auto arguments = std::make_shared<TrainVocabularyArguments>();
  TrainVocabularyArguments& a = *arguments;
  CLI::App* command =
      train.add_subcommand("vocabulary", "Learn visual words from the images of some folders");
  command->footer("placegraph train vocabulary streets houses --out words.pgw --kind float");
  command
      ->add_option("IMAGES", a.folders,
                   "folders of images, or with them in images/ or image_0/: other places than "
                   "those to be recognized")
      ->required()
      ->check(CLI::ExistingDirectory);
  command
      ->add_option("-o,--out", a.out, "file for the vocabulary")
      ->type_name(kOutput)
      ->required();
  command->add_option("--kind", a.kind, "words of binary descriptors or of SIFT")
      ->check(CLI::IsMember(vocabulary_kinds()))
      ->capture_default_str();
  command
      ->add_option("--words", a.words,
                   "approximate number of words; fewer if the images show fewer")
      ->check(CLI::Range(2, 1'000'000))
      ->capture_default_str();
  command->add_option("--descriptors", a.descriptors, "largest number of descriptors to learn from")
      ->check(CLI::Range(100, 100'000'000))
      ->capture_default_str();
  command->add_option("--seed", a.seed, kSeedText)->capture_default_str();
  command->add_flag("--force", a.force, kForceText);
  command->callback([arguments] { print(to_text(train_vocabulary(*arguments))); });
}

void add_vocabulary_command(CLI::App& places) {
  auto asked = std::make_shared<VocabularyInfoArguments>();
  CLI::App* info = places.add_subcommand("vocabulary", "Describe a vocabulary of visual words");
  info->footer("placegraph places vocabulary words.pgw");
  info
      ->add_option("FILE", asked->vocabulary, "the vocabulary")
      ->type_name(kInput)
      ->required();
  info->callback([asked] { print(to_text(vocabulary_info(*asked))); });
}

}  // namespace placegraph::apps
