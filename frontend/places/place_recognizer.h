#pragma once
#include <placegraph/frontend/places/dense_index.h>
#include <placegraph/frontend/places/place_likeness.h>
#include <placegraph/frontend/places/place_view.h>

#include <optional>
#include <vector>

namespace placegraph {

struct PlaceRecognizerOptions {
  PlaceCueOptions cues;
  int glanced = 300;    ///< views that pass a first look at all, at pooled cues
  int short_list = 60;  ///< of those, the views that are compared in full, after a second look
  int verified = 12;    ///< of those, the first by all cues, whose corners are compared
  int nominated = 8;    ///< and the first by each cue alone
  /// From so many views on, the first look follows a graph of neighbours instead of all views.
  int indexed_from = 20000;
  void check() const;
};
void visit(OptionVisitor& field, PlaceRecognizerOptions& options);

/// Views in the order they were added, and which of them an image resembles. Nothing is learned:
/// every score depends on two images alone. All cues are joined by a weighted sum; two coarse
/// looks name the views compared in full, so that only the first, a dot product, grows with their
/// number, and that not for long: many views are looked for along a graph of neighbours.
class PlaceRecognizer {
 public:
  explicit PlaceRecognizer(const PlaceRecognizerOptions& options);

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
  std::optional<DenseIndex> graph_;    ///< of the same; from half of indexed_from on
};

}  // namespace placegraph
