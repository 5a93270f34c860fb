#pragma once
#include <placegraph/frontend/places/descriptors/descriptor_retrieval.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace placegraph {

/// Similarities of images of different places, and how far another one stands out of them.
///
/// Their median and their median absolute deviation do not depend on a minority of pairs that show
/// one place after all (Rousseeuw & Croux 1993).
class StrangerScale {
 public:
  void add(double similarity) { values_.push_back(similarity); }
  std::size_t size() const { return values_.size(); }
  void clear() { values_.clear(); }
  /// Standardizes similarities: zero for the median, a deviation is one. Without values there is
  /// no scale, and all similarities are 0.
  void standardize(std::vector<double>& similarities) const;

 private:
  std::vector<double> values_;
};

/// A recognizer beside the appearance cues: the score of a view is the sum of what both say.
///
/// Their similarities have different units, and some recognizers distinguish places better than
/// others. Therefore each similarity is taken relative to those of strangers: pairs of a query and
/// a random view of its range, of the sequence itself and before the query. The views that
/// either finds are compared by both.
class CombinedRetrieval : public PlaceRetrieval {
 public:
  CombinedRetrieval(std::shared_ptr<ImageDescriber> describer, bool normalize,
                    const PlaceRecognizerOptions& options);

  void begin_frame(FrameId frame) override;
  void clear() override;
  void add(const Image& image) override;
  /// The best of the views that either finds, best first.
  std::vector<PlaceSimilarity> query(const Image& image, int first, int last) override;

 private:
  const PlaceView& view_of(const Image& image);
  void meet_strangers(const Image& image, int first, int last);

  DescriptorRetrieval descriptors_;
  PlaceRecognizer cues_;
  FrameId frame_;
  std::optional<FrameId> described_;  ///< frame of `view_`
  PlaceView view_;                    ///< the newest image as a query
  StrangerScale by_descriptor_, by_cues_;
};

}  // namespace placegraph
