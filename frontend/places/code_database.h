#pragma once
#include <placegraph/frontend/places/cues/corner_agreement.h>
#include <placegraph/frontend/places/landmarks.h>
#include <placegraph/frontend/places/place_database.h>
#include <placegraph/frontend/places/place_similarity.h>
#include <placegraph/graph/recognition/word_tree.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace placegraph {

/// Codes that describe an image by its visual words.
enum class PlaceCode {
  kBow,        ///< binary words of corners, tf-idf
  kBowFloat,   ///< words of SIFT key-points, tf-idf
  kLlc,        ///< locality-constrained linear codes of a grid, pooled over a spatial pyramid
  kLandmarks,  ///< the same codes of key-points, pooled over the landmarks that the key-points form
};

struct PlaceCodeOptions {
  CornerAgreementOptions corners{.max_corners = 500};  ///< corners for binary words
  FloatFeatureOptions features;
  LlcOptions llc;
  LandmarkOptions landmarks;
  PlaceDatabaseOptions online;  ///< binary words without a vocabulary file
  int listed = 60;              ///< number of views in a prediction
  void check() const;
};
void visit(OptionVisitor& field, PlaceCodeOptions& options);

/// Views first..last.
struct ViewRange {
  int first = 0, last = 0;
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

/// Creates a database. `vocabulary`: of binary words for kBow, where it is optional (without one,
/// words are learned from the images themselves, with `seed`), of SIFT words for the others;
/// ArgumentError for any other vocabulary.
std::unique_ptr<CodeDatabase> make_code_database(PlaceCode code, const PlaceCodeOptions& options,
                                                 std::optional<WordTree> vocabulary,
                                                 std::uint64_t seed);

}  // namespace placegraph
