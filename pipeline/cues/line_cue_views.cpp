#include <placegraph/pipeline/cues/line_cue.h>

// What others ask of the lines that are followed.
namespace placegraph {

LineView LineCue::seen() const {
  LineView seen;
  for (const LineTrack& track : tracker_.tracks())
    seen[track.id] = {track.edge.segment, track.edge.line.carriers(options_.sigma_floor_px)};
  return seen;
}

std::vector<PlacedLine> LineCue::placed(const SlidingWindow& window) const {
  std::vector<PlacedLine> placed;
  for (const LineTrack& track : tracker_.tracks()) {
    const auto line = window.line(track.id);
    const auto covariance = covariances_.find(track.id);
    if (line && covariance != covariances_.end())
      placed.push_back({track.id, *line, covariance->second, track.edge.segment});
  }
  return placed;
}

std::vector<double> LineCue::depths(const SlidingWindow& window) const {
  std::vector<double> result;
  for (const LineTrack& track : tracker_.tracks()) {
    const auto line = window.line(track.id);
    if (!line) continue;
    const auto z =
        depth_on_line(calibration_.camera, T_odom_last_, *line, track.edge.segment.middle());
    if (z && *z > 0) result.push_back(*z);
  }
  return result;
}

std::vector<double> LineCue::flow_px() const {
  std::vector<double> result;
  for (const LineTrack& track : tracker_.tracks())
    if (const auto at = at_keyframe_.find(track.id); at != at_keyframe_.end())
      result.push_back(std::abs(track.edge.segment.offset_of(at->second.middle())));
  return result;
}

int LineCue::followed(const SlidingWindow& window) const {
  int count = 0;
  for (const LineTrack& track : tracker_.tracks()) count += window.line(track.id).has_value();
  return count;
}

std::vector<FrameView::Line> LineCue::view(const SlidingWindow& window,
                                           const SE3& T_odom_cam) const {
  std::vector<FrameView::Line> lines;
  for (const LineTrack& track : tracker_.tracks()) {
    FrameView::Line seen{track.id, track.edge.segment, track.edge.line.carriers(), std::nullopt};
    if (const auto line = window.line(track.id))
      if (const auto r = line_residual_px(calibration_.camera, T_odom_cam, *line, seen.seen.first,
                                          seen.seen.second))
        seen.off_px = r->cwiseAbs().maxCoeff();
    lines.push_back(seen);
  }
  return lines;
}

std::vector<LineFeature> LineCue::features(const SlidingWindow& window,
                                           const SE3& T_odom_cam) const {
  std::vector<LineFeature> features;
  const Camera& camera = calibration_.camera;
  for (const LineTrack& track : tracker_.tracks()) {
    LineFeature feature{track.edge.segment, {}, std::nullopt};
    if (!camera.contains(feature.segment.start) || !camera.contains(feature.segment.end)) continue;
    if (const auto line = window.line(track.id)) {
      const Line3::Coordinates in_cam = transform_to(T_odom_cam, *line);
      const Eigen::Vector3d m = in_cam.head<3>(), v = in_cam.tail<3>();
      feature.line_cam = Line3::from_direction(v.cross(m) / v.squaredNorm(), v);
    }
    features.push_back(feature);
  }
  return features;
}

}  // namespace placegraph
