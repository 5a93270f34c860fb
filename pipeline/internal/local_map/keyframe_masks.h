#pragma once
#include <placegraph/graph/core/stage_times.h>
#include <placegraph/pipeline/internal/cues/surface_labels.h>

#include <memory>

namespace placegraph {

/// A keyframe as the cues use it.
struct KeyframeImages {
  Frame frame;                                  ///< its mask leaves out what its labels say
  Image given_mask;                             ///< the mask that it came with
  std::shared_ptr<const SurfaceLabels> labels;  ///< of its surfaces; null: not labelled
  /// 0 where the labels say that the frame shows no ground (CV_8UC1); empty where they say nothing.
  Image ground() const { return labels ? labels->masks.ground : Image(); }
  /// Whether labels have a part in the frame's mask.
  bool masked_by_labels() const { return labels && !labels->masks.use.empty(); }
};

/// Labels the surfaces of keyframes, and masks what they say is not to be used: the sky, what may
/// move. Without a model it leaves frames as they are.
class KeyframeMasks {
 public:
  /// `times`, which must outlive it, receives the CPU time of labelling.
  explicit KeyframeMasks(StageTimes& times) : times_(times) {}
  /// `masks`: whether the labels mask anything.
  void set_model(std::shared_ptr<const SurfaceLabeller> labeller, bool masks);
  /// Whether labels are trusted to tell where motion may be measured.
  void trust(bool trusted) { trusted_ = trusted; }
  /// A frame that becomes a keyframe, or may become one. The labels of the last frame are kept.
  [[nodiscard]] KeyframeImages apply(const Frame& frame);

 private:
  StageTimes& times_;
  std::shared_ptr<const SurfaceLabeller> labeller_;
  bool masks_ = false, trusted_ = true;
  std::shared_ptr<const SurfaceLabels> labels_;  // of the frame last labelled
};

}  // namespace placegraph
