#include <placegraph/pipeline/local_map/keyframe_masks.h>

#include <opencv2/core.hpp>

namespace placegraph {

void KeyframeMasks::set_model(std::shared_ptr<const SurfaceLabeller> labeller, bool masks) {
  labeller_ = std::move(labeller);
  masks_ = masks;
}

KeyframeImages KeyframeMasks::apply(const Frame& frame) {
  KeyframeImages images{frame, frame.mask, nullptr};
  if (!labeller_) return images;
  if (!labels_ || labels_->frame != frame.id) {
    const auto span = times_.measure("scene labels");
    labels_ = std::make_shared<const SurfaceLabels>(labeller_->label(frame, masks_ && trusted_));
  }
  images.labels = labels_;
  const Image& use = labels_->masks.use;
  if (use.empty()) return images;
  if (frame.mask.empty()) {
    images.frame.mask = use;
  } else {
    images.frame.mask = Image();  // the caller's mask must not change
    cv::bitwise_and(frame.mask, use, images.frame.mask);
  }
  return images;
}

}  // namespace placegraph
