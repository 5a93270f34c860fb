#pragma once
#include <placegraph/frontend/places/cues/place_cue_options.h>
#include <placegraph/frontend/places/place_recognizer.h>
#include <placegraph/frontend/places/recognition_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/image/image.h>
#include <placegraph/graph/recognition/word_tree.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Codes that describe an image by its visual words.
enum class PlaceCode {
  kBow,        ///< binary words of corners, tf-idf
  kBowFloat,   ///< words of SIFT key-points, tf-idf
  kLlc,        ///< locality-constrained linear codes of a grid, pooled over a spatial pyramid
  kLandmarks,  ///< the same codes of key-points, pooled over the landmarks that the key-points form
};

/// Key-points of an image that are described by SIFT.
struct FloatFeatureOptions {
  int width_px = 320;      ///< width to which images are resized, smaller ones too
  int max_features = 400;  ///< number of the strongest key-points kept in an image
  /// Minimum contrast of scale-space extrema, for grey levels in [0, 1]: a quarter of the usual
  /// value, as walls and lawns have only weak extrema.
  double contrast = 0.01;
  void check() const;
};
void visit(OptionVisitor& field, FloatFeatureOptions& options);

/// Codes of descriptors as sums of a few words.
struct LlcOptions {
  /// The deepest level of the vocabulary with at most this many words is used.
  int most_words = 1000;
  int neighbours = 5;   ///< number of words in the code of a descriptor
  double ridge = 1e-4;  ///< ridge, as a share of the trace of the local covariance
  /// Number of cells of the finer level of the spatial pyramid, across and down.
  int pyramid_rows = 2;
  void check() const;
};
void visit(OptionVisitor& field, LlcOptions& options);

/// Regions of key-points that may be found again.
struct LandmarkOptions {
  double bandwidth = 0.08;  ///< radius of the key-points of one landmark, as a share of the width
  int min_features = 3;     ///< minimum number of key-points of a landmark
  /// Maximum shift of a landmark between two views, as a share of the width.
  double max_shift = 0.25;
  /// Maximum number of landmarks of a view; those with the most key-points are kept.
  int max_landmarks = 40;
  void check() const;
};
void visit(OptionVisitor& field, LandmarkOptions& options);

/// Description of an image by each code.
struct PlaceCodeOptions {
  CornerAgreementOptions corners{.max_corners = 500};  ///< corners for binary words
  FloatFeatureOptions features;                        ///< SIFT key-points
  LlcOptions llc;                                      ///< codes of a grid or of key-points
  LandmarkOptions landmarks;                           ///< regions of key-points
  PlaceDatabaseOptions online;                         ///< binary words without a vocabulary file
  int listed = 60;                                     ///< number of views in a prediction
  void check() const;
};
void visit(OptionVisitor& field, PlaceCodeOptions& options);

/// Views first..last.
struct ViewRange {
  int first = 0, last = 0;  ///< both are included
};

/// Database of image codes, in the order of the images; retrieves similar images.
class CodeDatabase {
 public:
  virtual ~CodeDatabase() = default;
  /// Returns the views in `among` that are most similar to a grey image, best first, with scores in
  /// [0, 1] (none without `among`). The image is then stored as the next view.
  virtual std::vector<PlaceSimilarity> find_and_add(const Image& grey,
                                                    std::optional<ViewRange> among) = 0;
};

/// Creates an empty database of codes.
///
/// `vocabulary`: of binary words for kBow, where it is optional (without one, words are learned
/// from the images themselves, with `seed`), of SIFT words for the others; ArgumentError for any
/// other vocabulary.
std::unique_ptr<CodeDatabase> make_code_database(PlaceCode code, const PlaceCodeOptions& options,
                                                 std::optional<WordTree> vocabulary,
                                                 std::uint64_t seed);

}  // namespace placegraph
