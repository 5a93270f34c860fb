#pragma once
#include <placegraph/graph/image/image.h>
#include <placegraph/graph/recognition/word_tree.h>

#include <cstddef>
#include <cstdint>
#include <functional>

namespace [[gnu::visibility("default")]] placegraph {

/// What a vocabulary of visual words is trained for.
struct VocabularyTraining {
  WordTree::Kind kind = WordTree::Kind::kBinary;  ///< corners, or SIFT key-points and a grid
  int words = 10000;          ///< approximate number of words; fewer if the images show fewer
  int descriptors = 200'000;  ///< approximate largest number of descriptors to train on
  std::uint64_t seed = 1;     ///< seed of the clustering
};

/// Trains the visual words for CodeDatabase on images, with the weights of the words (idf).
///
/// `grey` returns an image, CV_8UC1; it is called once for each, in order. Float words are trained
/// on key-points and on grid points, half and half, so that one vocabulary serves words, codes and
/// landmarks. The tree has no words if no image has a feature. The same images and training give
/// the same bits. Throws ArgumentError without images, for fewer than two words and for fewer than
/// one descriptor.
WordTree train_vocabulary(std::size_t images, const std::function<Image(std::size_t)>& grey,
                          const VocabularyTraining& training);

}  // namespace placegraph
