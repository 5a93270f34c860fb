#include <placegraph/frontend/lines/line_depth.h>
#include <placegraph/pipeline/lines/line_prediction.h>

#include <optional>

namespace placegraph {

LineSegment moved_segment(const Camera& camera, const LineSegment& seen,
                          const std::array<double, 2>& depths, const SE3& T_new_old,
                          double typical_depth) {
  constexpr double kNear = 0.05;  // share of the typical depth
  const double least = kNear * typical_depth;
  std::array<Eigen::Vector3d, 2> ends;
  for (std::size_t k = 0; k < 2; ++k) {
    const auto ray = camera.unproject(k == 0 ? seen.start : seen.end);
    ends[k] = T_new_old * Eigen::Vector3d(depths[k] * ray.value_or(Eigen::Vector3d::UnitZ()));
  }
  for (std::size_t k = 0; k < 2; ++k)
    if (ends[k].z() < least && ends[1 - k].z() > least)
      ends[k] = ends[1 - k] + (ends[1 - k].z() - least) / (ends[1 - k].z() - ends[k].z()) *
                                  (ends[k] - ends[1 - k]);
  const auto start = camera.project(ends[0]), end = camera.project(ends[1]);
  if (!start || !end || ends[0].z() <= 0.5 * least || ends[1].z() <= 0.5 * least) return {};
  return {*start, *end};
}

std::vector<KnownDepth> known_depths(const Camera& camera, const std::vector<LineTrack>& tracks,
                                     const SlidingWindow& window, const SE3& T_odom_cam) {
  std::vector<KnownDepth> known;
  for (const LineTrack& track : tracks) {
    const auto line = window.line(track.id);
    if (!line) continue;
    const LineSegment& s = track.edge.segment;
    for (const Eigen::Vector2d& px : {s.start, s.middle(), s.end}) {
      const auto z = depth_on_line(camera, T_odom_cam, *line, px);
      if (z && *z > 0) known.push_back({px.cast<float>(), *z});
    }
  }
  return known;
}

std::vector<LineSegment> predict_segments(const Camera& camera,
                                          const std::vector<LineTrack>& tracks,
                                          const SlidingWindow& window,
                                          const LinePrediction& prediction,
                                          const std::map<LineId, double>& drift_px) {
  const SE3& T_odom_last = prediction.T_odom_last;
  const double depth = prediction.depth;
  const SE3 T_cam_last = prediction.T_odom_cam.inverse() * T_odom_last;
  const std::vector<KnownDepth> known = known_depths(camera, tracks, window, T_odom_last);
  std::vector<LineSegment> result;
  for (const LineTrack& track : tracks) {
    const LineSegment& now = track.edge.segment;
    const auto line = window.line(track.id);
    const double beside = line ? depth : depth_nearby(known, now.middle().cast<float>(), depth);
    std::array<double, 2> depths;
    for (std::size_t k = 0; k < 2; ++k) {
      const auto z = line ? depth_on_line(camera, T_odom_last, *line, k == 0 ? now.start : now.end)
                          : std::optional(beside);
      depths[k] = z && *z > 0 ? *z : depth;
    }
    LineSegment segment = moved_segment(camera, now, depths, T_cam_last, depth);
    if (const auto drift = drift_px.find(track.id);
        !line && drift != drift_px.end() && segment.length() > 1) {
      const Eigen::Vector2d across = drift->second * segment.normal();
      segment.start += across, segment.end += across;
    }
    result.push_back(segment);
  }
  return result;
}

}  // namespace placegraph
