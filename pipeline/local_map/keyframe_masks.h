#pragma once
#include <placegraph/graph/core/stage_times.h>
#include <placegraph/pipeline/cues/surface_labels.h>

#include <memory>

namespace placegraph {

/// A keyframe in the form used by the cues.
struct KeyframeImages {
  Frame frame;       ///< its mask excludes pixels according to the labels
  Image given_mask;  ///< original mask of the frame
  std::shared_ptr<const SurfaceLabels> labels;  ///< labels of its surfaces; null: not labelled
  /// 0 where the labels show that there is no ground (CV_8UC1); empty without such labels.
  Image ground() const { return labels ? labels->masks.ground : Image(); }
  /// Whether labels contributed to the frame's mask.
  bool masked_by_labels() const { return labels && !labels->masks.use.empty(); }
};

/// Labels the surfaces of keyframes, and masks those that must not be used: the sky and movable
/// objects. Without a model, frames remain unchanged.
class KeyframeMasks {
 public:
  /// `times`, which must outlive the object, receives the CPU time of labelling.
  explicit KeyframeMasks(StageTimes& times) : times_(times) {}
  /// Sets the model; `masks`: whether the labels are used as masks.
  void set_model(std::shared_ptr<const SurfaceLabeller> labeller, bool masks);
  /// Sets whether labels are trusted as masks for tracking.
  void trust(bool trusted) { trusted_ = trusted; }
  /// Masks a frame that becomes a keyframe, or may become one. The labels of the last frame are
  /// cached.
  [[nodiscard]] KeyframeImages apply(const Frame& frame);

 private:
  StageTimes& times_;
  std::shared_ptr<const SurfaceLabeller> labeller_;
  bool masks_ = false, trusted_ = true;
  std::shared_ptr<const SurfaceLabels> labels_;  // labels of the last labelled frame
};

}  // namespace placegraph
