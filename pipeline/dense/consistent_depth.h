#pragma once
#include <placegraph/pipeline/dense/keyframe_depth.h>

#include <deque>
#include <memory>
#include <utility>

namespace placegraph {

/// Settings of ConsistentDepth.
struct ConsistencyOptions {
  std::size_t reach = 5;      ///< number of keyframes before and after that are compared
  int least_agreeing = 2;     ///< number of other keyframes that must see a like depth
  double sigmas = 2;          ///< largest difference of like depths, in standard deviations
  double pose_share = 0.005;  ///< and beyond these, as a share of the depth: errors of the poses
  double most_sigma = 0.03;   ///< largest standard deviation of a depth that is used, as a share
  double bend = 0.02;         ///< as in remove_edges
  int radius_px = 3;          ///< as in estimate_normals
  double least_cosine = 0.1;  ///< as in estimate_normals
};

/// Depths on which neighbouring keyframes agree, without edges, and with normals.
///
/// A depth is compared with those of the keyframes before and after. A keyframe agrees if it sees a
/// surface of like depth there, sees through the point if its surface is farther, and says nothing
/// if its surface is nearer: that one hides the point. A depth remains if enough keyframes agree
/// and fewer see through it, and becomes the mean of the agreeing ones, weighted by their
/// uncertainty (Merrell et al. 2007, "Real-time visibility-based fusion of depth maps"). Its
/// uncertainty stays that of a single one, since the errors of stereo and of sensors repeat.
class ConsistentDepth final : public DepthOfKeyframe {
 public:
  ConsistentDepth(std::unique_ptr<DepthOfKeyframe> source, const ConsistencyOptions& options = {})
      : source_(std::move(source)), options_(options) {}

  std::size_t size() const override { return source_->size(); }
  KeyframeDepth of(std::size_t index) override;

 private:
  const KeyframeDepth& cleaned(std::size_t index);

  std::unique_ptr<DepthOfKeyframe> source_;
  ConsistencyOptions options_;
  std::deque<std::pair<std::size_t, KeyframeDepth>> read_;  ///< those around the last index
};

}  // namespace placegraph
