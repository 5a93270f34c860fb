#pragma once
#include <placegraph/frontend/places/dense_index.h>
#include <placegraph/frontend/places/descriptors/image_describer.h>
#include <placegraph/frontend/places/place_recognizer.h>

#include <memory>
#include <optional>
#include <vector>

namespace placegraph {

/// Retrieves images by the inner products of their descriptors.
///
/// The images of all calls are those of the frames that `begin_frame` has announced. A frame that
/// is described twice in a row, because it is a query and stored too, is described once.
class DescriptorRetrieval : public PlaceRetrieval {
 public:
  /// Number of stored images that a query returns: that of PlaceRecognizerOptions::short_list.
  static constexpr int kShortList = 60;

  /// `normalize`: whether descriptors are scaled to unit length, so that a score is a cosine.
  explicit DescriptorRetrieval(std::shared_ptr<ImageDescriber> describer, bool normalize = true);

  void begin_frame(FrameId frame) override { frame_ = frame; }
  void clear() override;
  /// Throws ArgumentError, as query does, for a descriptor that is empty, not finite, or of
  /// another length than the first; and for one of length zero that is to be normalized.
  void add(const Image& image) override;
  /// The kShortList best, best first.
  std::vector<PlaceSimilarity> query(const Image& image, int first, int last) override;

  /// Inner product of the descriptor of `image` and that of a stored one.
  double similarity(const Image& image, int view);
  int size() const { return index_ ? index_->size() : 0; }

 private:
  DenseIndex& index_with(const Image& image);

  std::shared_ptr<ImageDescriber> describer_;
  bool normalize_;
  FrameId frame_;
  std::optional<FrameId> described_;  ///< frame of `descriptor_`
  std::vector<float> descriptor_;     ///< of the newest image
  std::optional<DenseIndex> index_;   ///< from the first descriptor on
};

}  // namespace placegraph
