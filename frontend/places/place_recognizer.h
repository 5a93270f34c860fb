#pragma once
#include <placegraph/frontend/places/recognition_options.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/image/image.h>
#include <placegraph/graph/recognition/place_view.h>

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

/// Similarity of two views by all cues, the full comparison of PlaceRecognizer.
///
/// Both must be grey or both in colour (ArgumentError otherwise).
double place_similarity(const PlaceView& query, const PlaceView& stored,
                        const PlaceCueOptions& options);

/// Similarity of a stored image to a query.
struct PlaceSimilarity {
  int view = 0;  ///< index of the stored image
  /// Similarity; larger is more similar; comparable over queries, but not a probability.
  double score = 0;
};

/// A place recognizer of the caller's own, which Slam asks for loop candidates (SlamInputs).
///
/// Derive from this class. Slam adds the image of every keyframe and asks for candidates among
/// those of earlier ones; geometry decides which of them are loops. Images are in colour (BGR)
/// where the frames are, grey otherwise, 8 bits; they are valid during the call and must not be
/// changed. The functions are called on the thread that calls Slam; an exception propagates through
/// it. An object serves one run at a time.
class PlaceRetrieval {
 public:
  virtual ~PlaceRetrieval() = default;

  /// Announces the frame whose image is the next to be stored or asked for; ignored by default.
  ///
  /// The same frame may be announced again: its image is asked for, and stored. Images of one frame
  /// are equal until clear().
  virtual void begin_frame(FrameId frame) { (void)frame; }
  /// Forgets all images; called when a run begins.
  virtual void clear() = 0;
  /// Stores an image; its index is the number of images stored before.
  virtual void add(const Image& image) = 0;
  /// Returns stored images among first..last that may show the place of `image`, in any order.
  ///
  /// Candidates are examined in descending order of their scores, which must be finite and may have
  /// any unit. Images that do not resemble `image` should not be returned. Slam throws
  /// ArgumentError for a view outside of first..last and for one that is returned twice.
  virtual std::vector<PlaceSimilarity> query(const Image& image, int first, int last) = 0;
};

/// Retrieves the stored images (views) that are most similar to a query.
///
/// There is no training: every score depends on two images alone and is the weighted sum of all
/// cues. Two coarse comparisons choose the views that are compared in full. Only the time of the
/// first one, a dot product, grows with the number of views, up to
/// PlaceRecognizerOptions::indexed_from; with more views a graph of neighbours is searched.
class PlaceRecognizer {
 public:
  /// Starts without views. Throws ArgumentError for options that check() refuses.
  explicit PlaceRecognizer(const PlaceRecognizerOptions& options);
  ~PlaceRecognizer();
  PlaceRecognizer(PlaceRecognizer&&) noexcept;
  PlaceRecognizer& operator=(PlaceRecognizer&&) noexcept;

  /// Adds a view (describe_place) and returns its index: 0, 1, 2, ...
  ///
  /// If the view was described as a query, only its first scale is kept. Throws ArgumentError if
  /// the view is grey and the others are in colour, or the reverse, or if it was described by other
  /// cues.
  int add(PlaceView view);
  /// Returns the most similar views among first..last, at most `short_list`, best first.
  ///
  /// The range is cut to the existing views; the list is empty if there are none. `query` is a
  /// describe_place with `query` set, by the same cues (ArgumentError otherwise).
  std::vector<PlaceSimilarity> query(const PlaceView& query, int first, int last) const;
  /// Returns a stored view. Throws std::out_of_range for an index without a view.
  const PlaceView& view(int index) const { return views_.at(static_cast<std::size_t>(index)); }
  /// Number of stored views.
  int size() const { return static_cast<int>(views_.size()); }
  /// Options of the constructor.
  const PlaceRecognizerOptions& options() const { return options_; }

 private:
  std::vector<int> thumbnail(const PlaceView& query, int first, int last) const;
  std::vector<int> thumbnails_along_graph(const PlaceView& query, int first, int last) const;
  void grow_graph();

  PlaceRecognizerOptions options_;
  std::vector<PlaceView> views_;
  std::vector<std::int16_t> thumbnails_;  ///< thumbnails of the views, one after the other
  /// Neighbour graph of the thumbnails, built from half of indexed_from on.
  std::unique_ptr<DenseIndex> graph_;
};

}  // namespace placegraph
