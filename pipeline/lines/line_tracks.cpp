#include <placegraph/frontend/lines/line_triangulation.h>
#include <placegraph/pipeline/lines/line_tracks.h>

namespace placegraph {

LineView line_view(const std::vector<LineTrack>& tracks, double sigma_floor_px) {
  LineView seen;
  for (const LineTrack& track : tracks)
    seen[track.id] = {track.edge.segment, track.edge.line.carriers(sigma_floor_px)};
  return seen;
}

std::vector<double> depths_of_lines(const Camera& camera, const std::vector<LineTrack>& tracks,
                                    const SlidingWindow& window, const SE3& T_odom_cam) {
  std::vector<double> result;
  for (const LineTrack& track : tracks) {
    const auto line = window.line(track.id);
    if (!line) continue;
    const auto z = depth_on_line(camera, T_odom_cam, *line, track.edge.segment.middle());
    if (z && *z > 0) result.push_back(*z);
  }
  return result;
}

int count_lines(const std::vector<LineTrack>& tracks, const SlidingWindow& window) {
  int count = 0;
  for (const LineTrack& track : tracks) count += window.line(track.id).has_value();
  return count;
}

std::vector<FrameView::Line> view_of_lines(const Camera& camera,
                                           const std::vector<LineTrack>& tracks,
                                           const SlidingWindow& window, const SE3& T_odom_cam) {
  std::vector<FrameView::Line> lines;
  for (const LineTrack& track : tracks) {
    FrameView::Line seen{track.id, track.edge.segment, track.edge.line.carriers(), std::nullopt};
    if (const auto line = window.line(track.id))
      if (const auto r =
              line_residual_px(camera, T_odom_cam, *line, seen.seen.first, seen.seen.second))
        seen.off_px = r->cwiseAbs().maxCoeff();
    lines.push_back(seen);
  }
  return lines;
}

std::vector<LineFeature> features_of_lines(const Camera& camera,
                                           const std::vector<LineTrack>& tracks,
                                           const SlidingWindow& window, const SE3& T_odom_cam) {
  std::vector<LineFeature> features;
  for (const LineTrack& track : tracks) {
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
