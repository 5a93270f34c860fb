#include <placegraph/frontend/places/code_database.h>
#include <placegraph/frontend/places/cues/corner_agreement.h>
#include <placegraph/frontend/places/dense_index.h>
#include <placegraph/frontend/places/float_vocabulary.h>
#include <placegraph/frontend/places/inverted_index.h>
#include <placegraph/frontend/places/landmarks.h>
#include <placegraph/frontend/places/place_database.h>
#include <placegraph/frontend/places/place_similarity.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>

namespace placegraph {
namespace {

/// Binary words of a vocabulary, or without one, words learned from the images so far.
class OnlineBow final : public CodeDatabase {
 public:
  OnlineBow(const PlaceCodeOptions& options, std::uint64_t seed)
      : options_(options), database_(options.online, seed) {}

  std::vector<PlaceSimilarity> find_and_add(const Image& grey,
                                            std::optional<ViewRange> among) override {
    const std::vector<Feature> features = corners_of_view(grey, options_.corners);
    std::vector<PlaceSimilarity> list;
    if (among)
      for (const PlaceCandidate& candidate :
           database_.query(features, options_.listed, [&](KeyframeId id) {
             return id >= KeyframeId(among->first) && id <= KeyframeId(among->last);
           }))
        list.push_back({static_cast<int>(candidate.id.value()), candidate.score});
    database_.add(next_++, features);
    return list;
  }

 private:
  PlaceCodeOptions options_;
  PlaceDatabase database_;
  KeyframeId next_;  ///< the images are its keyframes
};

class Bow : public CodeDatabase {
 public:
  Bow(const PlaceCodeOptions& options, std::vector<float> idf)
      : options_(options), index_(std::move(idf)) {}

  std::vector<PlaceSimilarity> find_and_add(const Image& grey,
                                            std::optional<ViewRange> among) override {
    const std::vector<std::uint32_t> words = words_of(grey);
    std::vector<PlaceSimilarity> list;
    if (among) list = index_.query(words, options_.listed, among->first, among->last);
    index_.add(words);
    return list;
  }

 protected:
  virtual std::vector<std::uint32_t> words_of(const Image& grey) const = 0;
  PlaceCodeOptions options_;

 private:
  InvertedIndex index_;
};

class BinaryBow final : public Bow {
 public:
  BinaryBow(const PlaceCodeOptions& options, Vocabulary vocabulary)
      : Bow(options, vocabulary.tree().idf), vocabulary_(std::move(vocabulary)) {}

 private:
  std::vector<std::uint32_t> words_of(const Image& grey) const override {
    std::vector<std::uint32_t> words;
    for (const Feature& corner : corners_of_view(grey, options_.corners))
      words.push_back(vocabulary_.word(corner.descriptor));
    return words;
  }
  Vocabulary vocabulary_;
};

class FloatBow final : public Bow {
 public:
  FloatBow(const PlaceCodeOptions& options, FloatVocabulary vocabulary)
      : Bow(options, vocabulary.tree().idf), vocabulary_(std::move(vocabulary)) {}

 private:
  std::vector<std::uint32_t> words_of(const Image& grey) const override {
    const FloatFeatures features = float_features(grey, options_.features);
    std::vector<std::uint32_t> words;
    for (Eigen::Index i = 0; i < features.descriptors.rows(); ++i)
      words.push_back(vocabulary_.word(features.descriptors.row(i)));
    return words;
  }
  FloatVocabulary vocabulary_;
};

std::span<const float> span_of(const Eigen::VectorXf& vector) {
  return {vector.data(), static_cast<std::size_t>(vector.size())};
}

class LlcDatabase final : public CodeDatabase {
 public:
  LlcDatabase(const PlaceCodeOptions& options, const FloatVocabulary& vocabulary)
      : options_(options),
        words_(vocabulary.centres(options.llc.most_words)),
        index_(static_cast<int>(words_.rows()) *
               (1 + options.llc.pyramid_rows * options.llc.pyramid_rows)) {}

  std::vector<PlaceSimilarity> find_and_add(const Image& grey,
                                            std::optional<ViewRange> among) override {
    const FloatFeatures features = dense_float_features(grey);
    const int rows = options_.llc.pyramid_rows;
    const Eigen::VectorXf code =
        max_pooled(llc_codes(words_, features.descriptors, options_.llc),
                   static_cast<int>(words_.rows()), pyramid_cells(features, rows), rows * rows);
    std::vector<PlaceSimilarity> list;
    if (among) list = index_.query(span_of(code), options_.listed, among->first, among->last);
    index_.add(span_of(code));
    return list;
  }

 private:
  PlaceCodeOptions options_;
  FloatDescriptors words_;
  DenseIndex index_;
};

/// Retrieves by the sum of a view's landmarks first; then single landmarks are compared.
class LandmarkDatabase final : public CodeDatabase {
 public:
  LandmarkDatabase(const PlaceCodeOptions& options, const FloatVocabulary& vocabulary)
      : options_(options),
        words_(vocabulary.centres(options.llc.most_words)),
        index_(static_cast<int>(words_.rows())) {}

  std::vector<PlaceSimilarity> find_and_add(const Image& grey,
                                            std::optional<ViewRange> among) override {
    const FloatFeatures features = float_features(grey, options_.features);
    const auto words = static_cast<int>(words_.rows());
    std::vector<ImageLandmark> landmarks = find_landmarks(
        features, llc_codes(words_, features.descriptors, options_.llc), words, options_.landmarks);
    Eigen::VectorXf whole = Eigen::VectorXf::Zero(words);
    for (const ImageLandmark& landmark : landmarks) whole += landmark.code;
    if (whole.norm() > 0) whole.normalize();
    std::vector<PlaceSimilarity> list;
    if (among) {
      list = index_.query(span_of(whole), options_.listed, among->first, among->last);
      for (PlaceSimilarity& similarity : list)
        similarity.score =
            landmark_similarity(landmarks, views_[static_cast<std::size_t>(similarity.view)],
                                options_.landmarks.max_shift);
      keep_best(list, options_.listed);
    }
    index_.add(span_of(whole));
    views_.push_back(std::move(landmarks));
    return list;
  }

 private:
  PlaceCodeOptions options_;
  FloatDescriptors words_;
  DenseIndex index_;
  std::vector<std::vector<ImageLandmark>> views_;
};

}  // namespace

void FloatFeatureOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, FloatFeatureOptions& o) {
  field("width_px", o.width_px, "width to which images are resized", {64, 4096});
  field("max_features", o.max_features, "maximum number of key-points in an image", {20, 10000});
  field("contrast", o.contrast, "minimum contrast of extrema in scale space", {0.0001, 1});
}

void LlcOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, LlcOptions& o) {
  field("most_words", o.most_words,
        "maximum number of words of the level of the vocabulary that is used", {2, 100000});
  field("neighbours", o.neighbours, "number of words in the code of a descriptor", {1, 100});
  field("ridge", o.ridge, "ridge, as a share of the trace of the local covariance", {1e-9, 1});
  field("pyramid_rows", o.pyramid_rows,
        "number of cells of the finer level of the spatial pyramid, across and down", {1, 16});
}

void LandmarkOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, LandmarkOptions& o) {
  field("bandwidth", o.bandwidth,
        "radius of the key-points of one landmark, as a share of the width", {0.005, 1});
  field("min_features", o.min_features, "minimum number of key-points of a landmark", {1, 1000});
  field("max_shift", o.max_shift,
        "maximum shift of a landmark between two views, as a share of the width", {0, 10});
  field("max_landmarks", o.max_landmarks, "maximum number of landmarks of a view", {1, 1000});
}

void PlaceCodeOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, PlaceCodeOptions& o) {
  field.group("corners", o.corners, "corners for binary words");
  field.group("features", o.features, "SIFT key-points");
  field.group("llc", o.llc, "codes of descriptors as sums of a few words");
  field.group("landmarks", o.landmarks, "regions of key-points");
  field.group("online", o.online, "binary words without a vocabulary file");
  field("listed", o.listed, "number of views in a prediction", {1, 1e6});
}

std::unique_ptr<CodeDatabase> make_code_database(PlaceCode code, const PlaceCodeOptions& options,
                                                 std::optional<WordTree> vocabulary,
                                                 std::uint64_t seed) {
  options.check();
  if (code == PlaceCode::kBow) {
    if (!vocabulary) return std::make_unique<OnlineBow>(options, seed);
    return std::make_unique<BinaryBow>(options, Vocabulary(std::move(*vocabulary)));
  }
  require(vocabulary.has_value(), "make_code_database: this code needs a vocabulary");
  FloatVocabulary words(std::move(*vocabulary));
  require(words.dimension() == kSiftNumbers,
          "make_code_database: the vocabulary does not have SIFT words");
  if (code == PlaceCode::kBowFloat) return std::make_unique<FloatBow>(options, std::move(words));
  if (code == PlaceCode::kLlc) return std::make_unique<LlcDatabase>(options, words);
  return std::make_unique<LandmarkDatabase>(options, words);
}

}  // namespace placegraph
