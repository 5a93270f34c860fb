#include <placegraph/frontend/flow/flow_cues.h>
#include <placegraph/graph/core/median.h>
#include <placegraph/pipeline/tracking/keyframe_selector.h>

namespace placegraph {

void KeyframeSelector::start(const std::vector<PointTrack>& tracks, int landmarks) {
  px_at_keyframe_.clear();
  for (const PointTrack& track : tracks) px_at_keyframe_[track.id] = track.px.cast<double>();
  landmarks_ = landmarks;
  frames_ = 0;
}

void KeyframeSelector::reset() { start({}, 0); }

bool KeyframeSelector::due(const Overlap& overlap) const {
  constexpr std::size_t kMinTracks = 10;  // minimum number for a displacement
  if (overlap.inliers < options_.min_tracked_share * landmarks_) return true;
  // Creates a keyframe before too few landmarks remain for a pose, if other tracks can become
  // landmarks.
  if (overlap.more_tracks && overlap.inliers < 2 * min_inliers_) return true;
  if (overlap.flow_px.size() < kMinTracks) return true;
  const double share = median_of(overlap.flow_px) / camera_.width;
  return share > options_.max_flow_share ||
         (frames_ >= options_.max_interval && share > 0.1 * options_.max_flow_share);
}

std::vector<double> KeyframeSelector::flow_px(const std::vector<PointTrack>& tracks,
                                              const SO3& R_keyframe_cam) const {
  std::vector<double> lengths_px;
  std::vector<FlowVector> flow;
  for (const PointTrack& track : tracks) {
    const auto at_keyframe = px_at_keyframe_.find(track.id);
    if (at_keyframe == px_at_keyframe_.end()) continue;
    const Eigen::Vector2d moved_px = track.px.cast<double>() - at_keyframe->second;
    lengths_px.push_back(moved_px.norm());
    FlowVector& vector = flow.emplace_back();
    vector.kind = FlowVector::Kind::kFull;
    vector.px = at_keyframe->second;
    vector.flow = moved_px;
  }
  if (!options_.derotated) return lengths_px;
  lengths_px.clear();
  for (const DerotatedFlow& vector : derotate(camera_, flow, {R_keyframe_cam}))
    lengths_px.push_back(camera_.fx * vector.flow().norm());
  return lengths_px;
}

}  // namespace placegraph
