#pragma once
#include <cstddef>
#include <string>

namespace placegraph::apps {

struct VocabularyInfoArguments {
  std::string vocabulary;  ///< file written by train_vocabulary
};

struct VocabularyInfoResult {
  std::string vocabulary, kind;
  int words = 0;
  std::size_t nodes = 0;
  double wall_ms = 0;  ///< time to read the file
};

/// Summarizes a vocabulary: `placegraph places vocabulary`. Throws FileError.
VocabularyInfoResult vocabulary_info(const VocabularyInfoArguments& arguments);

/// One line.
std::string to_text(const VocabularyInfoResult& result);

}  // namespace placegraph::apps
