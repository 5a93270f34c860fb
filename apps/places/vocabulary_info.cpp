#include "apps/places/vocabulary_info.h"

#include <fmt/format.h>
#include <placegraph/io/models/vocabulary_file.h>

#include "apps/places/train_vocabulary.h"
#include "apps/support/usage.h"

namespace placegraph::apps {

VocabularyInfoResult vocabulary_info(const VocabularyInfoArguments& arguments) {
  const Stopwatch watch;
  const WordTree tree = read_vocabulary(arguments.vocabulary);
  const double wall_ms = watch.wall_ms();
  return {arguments.vocabulary, vocabulary_kinds().at(static_cast<std::size_t>(tree.kind)),
          tree.words, tree.nodes.size(), wall_ms};
}

std::string to_text(const VocabularyInfoResult& result) {
  return fmt::format("{}: {} {} words, {} nodes, read in {:.0f} ms\n", result.vocabulary,
                     result.words, result.kind, result.nodes, result.wall_ms);
}

}  // namespace placegraph::apps
