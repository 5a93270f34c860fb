#pragma once
#include <cstddef>
#include <string>

namespace placegraph::apps {

struct VocabularyInfoArguments {
  std::string vocabulary;  ///< file of train_vocabulary
};

struct VocabularyInfoResult {
  std::string vocabulary, kind;
  int words = 0;
  std::size_t nodes = 0;
  double wall_ms = 0;  ///< of reading it
};

/// `placegraph vocabulary info`: what a vocabulary holds. Throws FileError.
VocabularyInfoResult vocabulary_info(const VocabularyInfoArguments& arguments);

/// One line.
std::string to_text(const VocabularyInfoResult& result);

}  // namespace placegraph::apps
