#pragma once
#include <placegraph/frontend/places/recognition_options.h>
#include <placegraph/graph/image/image.h>
#include <placegraph/graph/place_view.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

class DenseIndex;

/// Describes the appearance of an image by all cues whose weight is not 0.
///
/// `image` is grey or BGR, 8 bits (ArgumentError otherwise). A `query` is described at three scales
/// (1, 1 / zoom, zoom) instead of one, for which it takes about three times as long.
PlaceView describe_place(const Image& image, const PlaceCueOptions& options, bool query);

/// How similar a stored image is to a query.
struct PlaceSimilarity {
  int view = 0;      ///< index of the stored image
  double score = 0;  ///< larger is more similar; comparable over queries, but no probability
};

/// Finds the stored images (views) that look most like a query.
///
/// Nothing is learned: every score depends on two images alone, as the weighted sum of all cues.
/// Two coarse comparisons choose the views that are compared in full. Only the first, a dot
/// product, takes time that grows with the number of views, up to
/// PlaceRecognizerOptions::indexed_from; beyond, a graph of neighbours is searched.
class PlaceRecognizer {
 public:
  /// Begins without views. Throws ArgumentError for options that check() refuses.
  explicit PlaceRecognizer(const PlaceRecognizerOptions& options);
  ~PlaceRecognizer();
  PlaceRecognizer(PlaceRecognizer&&) noexcept;
  PlaceRecognizer& operator=(PlaceRecognizer&&) noexcept;

  /// Adds a view (describe_place) and returns its index: 0, 1, 2, ...
  ///
  /// Of a query's scales only the first is kept. Throws ArgumentError if it is grey and the others
  /// are in colour, or the reverse, or it was described by other cues.
  int add(PlaceView view);
  /// The most similar views among first..last, at most `short_list`, best first.
  ///
  /// The range is cut to the views that exist; the list is empty if there are none. `query` is a
  /// describe_place with `query` set, by the same cues (ArgumentError otherwise).
  std::vector<PlaceSimilarity> query(const PlaceView& query, int first, int last) const;
  /// A stored view. Throws std::out_of_range for an index that no view has.
  const PlaceView& view(int index) const { return views_.at(static_cast<std::size_t>(index)); }
  /// Number of stored views.
  int size() const { return static_cast<int>(views_.size()); }
  /// The options it was made with.
  const PlaceRecognizerOptions& options() const { return options_; }

 private:
  std::vector<int> thumbnail(const PlaceView& query, int first, int last) const;
  std::vector<int> thumbnails_along_graph(const PlaceView& query, int first, int last) const;
  void grow_graph();

  PlaceRecognizerOptions options_;
  std::vector<PlaceView> views_;
  std::vector<std::int16_t> glances_;  ///< of the views, one after the other
  std::unique_ptr<DenseIndex> graph_;  ///< of the same; from half of indexed_from on
};

}  // namespace placegraph
