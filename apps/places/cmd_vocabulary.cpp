#include "apps/places/cmd_vocabulary.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/places/train_vocabulary.h"
#include "apps/places/vocabulary_info.h"
#include "apps/support/output.h"

namespace placegraph::apps {

void add_vocabulary_command(CLI::App& app) {
  CLI::App* vocabulary = app.add_subcommand("vocabulary", "Visual words for `match --codes`");
  vocabulary->footer("placegraph vocabulary train streets houses --out words.pgw");
  vocabulary->require_subcommand(1);
  auto arguments = std::make_shared<TrainVocabularyArguments>();
  TrainVocabularyArguments& a = *arguments;
  CLI::App* command =
      vocabulary->add_subcommand("train", "Learn visual words from the images of some folders");
  command->footer("placegraph vocabulary train streets houses --out words.pgw --kind float");
  command
      ->add_option("IMAGES", a.folders,
                   "folders of images, or with them in images/ or image_0/: other places than "
                   "those to be told apart")
      ->required()
      ->check(CLI::ExistingDirectory);
  command->add_option("--out", a.out, "write the vocabulary")->required();
  command->add_option("--kind", a.kind, "words of binary descriptors or of SIFT")
      ->check(CLI::IsMember(vocabulary_kinds()))
      ->capture_default_str();
  command->add_option("--words", a.words, "how many, about; fewer where images show fewer")
      ->check(CLI::Range(2, 1'000'000))
      ->capture_default_str();
  command->add_option("--descriptors", a.descriptors, "to learn from, at most")
      ->check(CLI::Range(100, 100'000'000))
      ->capture_default_str();
  command->add_option("--seed", a.seed, "of the clustering")->capture_default_str();
  command->add_flag("--force", a.force, "overwrite files");
  command->callback([arguments] { print(to_text(train_vocabulary(*arguments))); });

  auto asked = std::make_shared<VocabularyInfoArguments>();
  CLI::App* info = vocabulary->add_subcommand("info", "What a vocabulary holds");
  info->footer("placegraph vocabulary info words.pgw");
  info->add_option("FILE", asked->vocabulary, "the vocabulary")->required();
  info->callback([asked] { print(to_text(vocabulary_info(*asked))); });
}

}  // namespace placegraph::apps
