#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace placegraph::apps {

/// The kinds of words, in the order of WordTree::Kind.
const std::vector<std::string>& vocabulary_kinds();

struct TrainVocabularyArguments {
  std::vector<std::string> folders;  ///< of images, or with them in images/ or image_0/
  std::string out;                   ///< the vocabulary to write
  std::string kind = vocabulary_kinds().front();
  int words = 10000;          ///< about; fewer where images show fewer
  int descriptors = 200'000;  ///< to learn from, at most
  std::uint64_t seed = 1;     ///< of the clustering
  bool force = false;         ///< overwrite `out`
};

struct TrainVocabularyResult {
  std::string out, kind;
  int words = 0;
  std::size_t images = 0;  ///< that were learned from
};

/// `placegraph vocabulary train`: learns visual words from the images of some folders. Progress and
/// warnings go to stderr. Throws ArgumentError, FileError, and NoAnswer where no image shows
/// anything to learn from; then nothing is written.
TrainVocabularyResult train_vocabulary(const TrainVocabularyArguments& arguments);

/// One line.
std::string to_text(const TrainVocabularyResult& result);

}  // namespace placegraph::apps
