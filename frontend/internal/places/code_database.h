#pragma once
#include <placegraph/frontend/internal/places/cues/corner_agreement.h>
#include <placegraph/frontend/internal/places/landmarks.h>
#include <placegraph/frontend/internal/places/place_database.h>
#include <placegraph/frontend/places/place_similarity.h>
#include <placegraph/graph/internal/word_tree.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace placegraph {

/// How an image is told from others by the visual words it shows.
enum class PlaceCode {
  kBow,        ///< binary words of corners, tf-idf
  kBowFloat,   ///< words of SIFT key-points, tf-idf
  kLlc,        ///< locality-constrained linear codes of a grid, pooled over a spatial pyramid
  kLandmarks,  ///< the same of key-points, pooled over the landmarks they make up
};

struct PlaceCodeOptions {
  CornerAgreementOptions corners{.max_corners = 500};  ///< of binary words
  FloatFeatureOptions features;
  LlcOptions llc;
  LandmarkOptions landmarks;
  PlaceDatabaseOptions online;  ///< binary words without a vocabulary file
  int listed = 60;              ///< views an answer names
  void check() const;
};
void visit(OptionVisitor& field, PlaceCodeOptions& options);

/// Views first..last.
struct ViewRange {
  int first = 0, last = 0;
};

/// Images as codes, in the order they were seen, and which of them another resembles.
class CodeDatabase {
 public:
  virtual ~CodeDatabase() = default;
  /// The views `among` that are most like a grey image, best first, scores in [0, 1] (none without
  /// `among`); the image is stored as the next view then.
  virtual std::vector<PlaceSimilarity> look_up_and_add(const Image& grey,
                                                       std::optional<ViewRange> among) = 0;
};

/// `vocabulary`: of binary words for kBow, where none is needed (words are then learned from the
/// images themselves, with `seed`), of SIFT for the others; ArgumentError if it is another.
std::unique_ptr<CodeDatabase> make_code_database(PlaceCode code, const PlaceCodeOptions& options,
                                                 std::optional<WordTree> vocabulary,
                                                 std::uint64_t seed);

}  // namespace placegraph
