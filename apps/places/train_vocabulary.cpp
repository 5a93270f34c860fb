#include "apps/places/train_vocabulary.h"

#include <fmt/format.h>
#include <placegraph/frontend/places/code_database.h>
#include <placegraph/frontend/places/float_vocabulary.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/files/image_list.h>
#include <placegraph/io/models/vocabulary_file.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core/utility.hpp>

#include "apps/support/choice.h"
#include "apps/support/image_range.h"
#include "apps/support/output.h"
#include "apps/support/progress.h"

namespace placegraph::apps {

const std::vector<std::string>& vocabulary_kinds() {
  static const std::vector<std::string> names = {"binary", "float"};
  return names;
}

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

std::vector<std::string> all_images_of(const TrainVocabularyArguments& arguments) {
  std::vector<std::string> images;
  for (const std::string& folder : arguments.folders)
    for (std::string& image : list_images(image_folder_of(folder)))
      images.push_back(std::move(image));
  return images;
}

// Consecutive images are similar, so many descriptors of some images are better than few of all.
std::vector<std::string> thinned(std::vector<std::string> images, int descriptors) {
  constexpr std::size_t kOfAnImage = 150;
  const std::size_t stride = images.size() * kOfAnImage / static_cast<std::size_t>(descriptors) + 1;
  std::vector<std::string> kept;
  for (std::size_t i = 0; i < images.size(); i += stride) kept.push_back(std::move(images[i]));
  return kept;
}

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

WordTree train_binary(const TrainVocabularyArguments& arguments,
                      const std::vector<std::string>& images, std::size_t share) {
  WordTrainingSet<std::vector<BinaryDescriptor>> training_set;
  Progress progress("describing", static_cast<std::int64_t>(images.size()), "images");
  CornerAgreementOptions options = PlaceCodeOptions{}.corners;
  options.max_corners = std::min(options.max_corners, static_cast<int>(share));
  for (std::size_t i = 0; i < images.size(); ++i) {
    for (const Feature& corner : corners_of_view(read_image(images[i]).grey, options))
      training_set.descriptors.push_back(corner.descriptor);
    training_set.end.push_back(static_cast<int>(training_set.descriptors.size()));
    progress.update(static_cast<std::int64_t>(i) + 1);
  }
  if (training_set.descriptors.empty()) throw NoResult("no image has a corner to learn words from");
  Random random(arguments.seed);
  Vocabulary vocabulary =
      Vocabulary::train(training_set.descriptors, tree_of(arguments.words), random);
  vocabulary.set_idf(idf_of(training_set.end, vocabulary.words(), [&](int i) {
    return vocabulary.word(training_set.descriptors[static_cast<std::size_t>(i)]);
  }));
  return vocabulary.tree();
}

// Key points and grid points, half and half: one vocabulary serves words, codes and landmarks.
WordTree train_float(const TrainVocabularyArguments& arguments,
                     const std::vector<std::string>& images, std::size_t share) {
  std::vector<FloatDescriptors> parts;
  WordTrainingSet<FloatDescriptors> training_set;
  Progress progress("describing", static_cast<std::int64_t>(images.size()), "images");
  FloatFeatureOptions options = PlaceCodeOptions{}.features;
  options.max_features = std::min(options.max_features, static_cast<int>((share + 1) / 2));
  int rows = 0;
  for (std::size_t i = 0; i < images.size(); ++i) {
    const Image grey = read_image(images[i]).grey;
    parts.push_back(float_features(grey, options).descriptors);
    rows += static_cast<int>(parts.back().rows());
    const FloatDescriptors dense = dense_float_features(grey).descriptors;
    const Eigen::Index stride = dense.rows() * 2 / static_cast<Eigen::Index>(share) + 1;
    FloatDescriptors thinned((dense.rows() + stride - 1) / stride, dense.cols());
    for (Eigen::Index k = 0; k < thinned.rows(); ++k) thinned.row(k) = dense.row(k * stride);
    rows += static_cast<int>(thinned.rows());
    parts.push_back(std::move(thinned));
    training_set.end.push_back(rows);
    progress.update(static_cast<std::int64_t>(i) + 1);
  }
  training_set.descriptors.resize(rows, kSiftNumbers);
  Eigen::Index row = 0;
  for (const FloatDescriptors& part : parts) {
    training_set.descriptors.middleRows(row, part.rows()) = part;
    row += part.rows();
  }
  if (rows == 0) throw NoResult("no image has anything to learn words from");
  Random random(arguments.seed);
  FloatVocabulary vocabulary =
      FloatVocabulary::train(training_set.descriptors, tree_of(arguments.words), random);
  vocabulary.set_idf(idf_of(training_set.end, vocabulary.words(), [&](int i) {
    return vocabulary.word(training_set.descriptors.row(i));
  }));
  return vocabulary.tree();
}

}  // namespace

TrainVocabularyResult train_vocabulary(const TrainVocabularyArguments& arguments) {
  const auto kind = choice<WordTree::Kind>("--kind", vocabulary_kinds(), arguments.kind);
  require_free(arguments.out, arguments.force);
  cv::setNumThreads(1);
  const std::vector<std::string> images = thinned(all_images_of(arguments), arguments.descriptors);
  const std::size_t share =
      std::max<std::size_t>(2, static_cast<std::size_t>(arguments.descriptors) / images.size());
  const WordTree tree = kind == WordTree::Kind::kBinary ? train_binary(arguments, images, share)
                                                        : train_float(arguments, images, share);
  if (tree.words < arguments.words / 2)
    warn(fmt::format("{} words, not {}: the images show no more", tree.words, arguments.words));
  write_vocabulary(arguments.out, tree);
  return {arguments.out, arguments.kind, tree.words, images.size()};
}

std::string to_text(const TrainVocabularyResult& result) {
  return fmt::format("{} {} words learned from {} images, written to {}\n", result.words,
                     result.kind, result.images, result.out);
}

}  // namespace placegraph::apps
