#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace placegraph::apps {

/// Names of the kinds of words, in the order of WordTree::Kind.
const std::vector<std::string>& vocabulary_kinds();

struct TrainVocabularyArguments {
  std::vector<std::string> folders;  ///< folders of images, or with images in images/ or image_0/
  std::string out;                   ///< file for the vocabulary
  std::string kind = vocabulary_kinds().front();
  int words = 10000;          ///< approximate number of words; fewer if the images show fewer
  int descriptors = 200'000;  ///< largest number of descriptors to learn from
  std::uint64_t seed = 1;     ///< seed of the clustering
  bool force = false;         ///< overwrite `out`
};

struct TrainVocabularyResult {
  std::string out, kind;
  int words = 0;
  std::size_t images = 0;  ///< number of training images
};

/// Learns visual words from the images of some folders: `placegraph train vocabulary`.
/// Progress and warnings go to stderr. Throws ArgumentError, FileError, and NoResult if no image
/// has a feature; then nothing is written.
TrainVocabularyResult train_vocabulary(const TrainVocabularyArguments& arguments);

/// One line.
std::string to_text(const TrainVocabularyResult& result);

}  // namespace placegraph::apps
