#pragma once
#include <placegraph/frontend/places/recognition_options.h>
#include <placegraph/graph/image/image.h>
#include <placegraph/graph/place_view.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

class DenseIndex;

/// `image`: grey or BGR, 8 bits (ArgumentError otherwise). A `query` costs three scales instead of
/// one; cues of weight 0 stay empty.
PlaceView describe_place(const Image& image, const PlaceCueOptions& options, bool query);

/// How much a stored view looks like the query: comparable over queries, no probability.
struct PlaceLikeness {
  int view = 0;
  double score = 0;
};

/// Views in the order they were added, and which of them an image resembles. Nothing is learned:
/// every score depends on two images alone. All cues are joined by a weighted sum; two coarse
/// looks name the views compared in full, so that only the first, a dot product, grows with their
/// number, and that not for long: many views are looked for along a graph of neighbours.
class PlaceRecognizer {
 public:
  explicit PlaceRecognizer(const PlaceRecognizerOptions& options);
  ~PlaceRecognizer();
  PlaceRecognizer(PlaceRecognizer&&) noexcept;
  PlaceRecognizer& operator=(PlaceRecognizer&&) noexcept;

  /// The index of the new view: 0, 1, ... Of a query's scales only the first is kept. Views are all
  /// grey or all in colour (ArgumentError otherwise).
  int add(PlaceView view);
  /// The short list among the views first..last (cut to those there are), best first.
  std::vector<PlaceLikeness> query(const PlaceView& query, int first, int last) const;
  const PlaceView& view(int index) const { return views_.at(static_cast<std::size_t>(index)); }
  int size() const { return static_cast<int>(views_.size()); }
  const PlaceRecognizerOptions& options() const { return options_; }

 private:
  std::vector<int> glance(const PlaceView& query, int first, int last) const;
  std::vector<int> glance_along_graph(const PlaceView& query, int first, int last) const;
  void grow_graph();

  PlaceRecognizerOptions options_;
  std::vector<PlaceView> views_;
  std::vector<std::int16_t> glances_;  ///< of the views, one after the other
  std::unique_ptr<DenseIndex> graph_;  ///< of the same; from half of indexed_from on
};

}  // namespace placegraph
