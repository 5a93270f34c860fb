#include <placegraph/frontend/places/code_database.h>
#include <placegraph/frontend/places/cues/corner_agreement.h>
#include <placegraph/frontend/places/float_features.h>
#include <placegraph/frontend/places/float_vocabulary.h>
#include <placegraph/frontend/places/vocabulary_training.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

/// Descriptors of all images, those of one image next to each other.
template <class Descriptors>
struct WordTrainingSet {
  Descriptors descriptors;
  std::vector<int> end;  ///< end index of each image's descriptors
};

// The fewest levels with small nodes; the number of children follows from the number of words.
VocabularyOptions tree_of(int words) {
  constexpr double kChildren = 24;
  VocabularyOptions options;
  options.depth =
      std::clamp(static_cast<int>(std::ceil(std::log(words) / std::log(kChildren) - 1e-9)), 1, 6);
  options.branching =
      std::clamp(static_cast<int>(std::ceil(std::pow(words, 1.0 / options.depth) - 1e-9)), 2, 64);
  return options;
}

/// Returns an image, by its number.
using GreyOf = std::function<Image(std::size_t)>;

/// log((1 + images) / (1 + images with the word)).
template <class WordOf>
std::vector<float> idf_of(const std::vector<int>& end, int words, const WordOf& word_of) {
  std::vector<int> images(static_cast<std::size_t>(words), 0), last(images.size(), -1);
  for (int image = 0, i = 0; image < static_cast<int>(end.size()); ++image)
    for (; i < end[static_cast<std::size_t>(image)]; ++i) {
      const auto word = static_cast<std::size_t>(word_of(i));
      if (last[word] != image) ++images[word];
      last[word] = image;
    }
  std::vector<float> idf;
  for (const int with : images)
    idf.push_back(static_cast<float>(
        std::log((1.0 + static_cast<double>(end.size())) / (1.0 + static_cast<double>(with)))));
  return idf;
}

WordTree train_binary(std::size_t images, const GreyOf& grey, std::size_t share,
                      const VocabularyTraining& training) {
  WordTrainingSet<std::vector<BinaryDescriptor>> training_set;
  CornerAgreementOptions options = PlaceCodeOptions{}.corners;
  options.max_corners = std::min(options.max_corners, static_cast<int>(share));
  for (std::size_t i = 0; i < images; ++i) {
    for (const Feature& corner : corners_of_view(grey(i), options))
      training_set.descriptors.push_back(corner.descriptor);
    training_set.end.push_back(static_cast<int>(training_set.descriptors.size()));
  }
  if (training_set.descriptors.empty()) return {};
  Random random(training.seed);
  Vocabulary vocabulary =
      Vocabulary::train(training_set.descriptors, tree_of(training.words), random);
  vocabulary.set_idf(idf_of(training_set.end, vocabulary.words(), [&](int i) {
    return vocabulary.word(training_set.descriptors[static_cast<std::size_t>(i)]);
  }));
  return vocabulary.tree();
}

FloatDescriptors every_nth_row(const FloatDescriptors& rows, Eigen::Index stride) {
  FloatDescriptors thinned((rows.rows() + stride - 1) / stride, rows.cols());
  for (Eigen::Index k = 0; k < thinned.rows(); ++k) thinned.row(k) = rows.row(k * stride);
  return thinned;
}

// Key points and grid points, half and half: one vocabulary serves words, codes and landmarks.
WordTrainingSet<FloatDescriptors> float_training_set(std::size_t images, const GreyOf& grey_of,
                                                     std::size_t share) {
  std::vector<FloatDescriptors> parts;
  WordTrainingSet<FloatDescriptors> training_set;
  FloatFeatureOptions options = PlaceCodeOptions{}.features;
  options.max_features = std::min(options.max_features, static_cast<int>((share + 1) / 2));
  int rows = 0;
  for (std::size_t i = 0; i < images; ++i) {
    const Image grey = grey_of(i);
    parts.push_back(float_features(grey, options).descriptors);
    rows += static_cast<int>(parts.back().rows());
    const FloatDescriptors dense = dense_float_features(grey).descriptors;
    parts.push_back(every_nth_row(dense, dense.rows() * 2 / static_cast<Eigen::Index>(share) + 1));
    rows += static_cast<int>(parts.back().rows());
    training_set.end.push_back(rows);
  }
  training_set.descriptors.resize(rows, kSiftNumbers);
  Eigen::Index row = 0;
  for (const FloatDescriptors& part : parts) {
    training_set.descriptors.middleRows(row, part.rows()) = part;
    row += part.rows();
  }
  return training_set;
}

WordTree train_float(std::size_t images, const GreyOf& grey, std::size_t share,
                     const VocabularyTraining& training) {
  const WordTrainingSet<FloatDescriptors> training_set = float_training_set(images, grey, share);
  if (training_set.descriptors.rows() == 0) return {};
  Random random(training.seed);
  FloatVocabulary vocabulary =
      FloatVocabulary::train(training_set.descriptors, tree_of(training.words), random);
  vocabulary.set_idf(idf_of(training_set.end, vocabulary.words(), [&](int i) {
    return vocabulary.word(training_set.descriptors.row(i));
  }));
  return vocabulary.tree();
}

}  // namespace

WordTree train_vocabulary(std::size_t images, const std::function<Image(std::size_t)>& grey,
                          const VocabularyTraining& training) {
  require(images > 0, "train_vocabulary: there are no images");
  require(training.words >= 2, "train_vocabulary: at least two words are needed");
  require(training.descriptors >= 1, "train_vocabulary: at least one descriptor is needed");
  const std::size_t share =
      std::max<std::size_t>(2, static_cast<std::size_t>(training.descriptors) / images);
  return training.kind == WordTree::Kind::kBinary ? train_binary(images, grey, share, training)
                                                  : train_float(images, grey, share, training);
}

}  // namespace placegraph
