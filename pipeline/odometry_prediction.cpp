#include <placegraph/pipeline/odometry.h>

#include <algorithm>
#include <array>
#include <limits>

namespace placegraph {
namespace {

/// A point with a known depth, as the last frame saw it.
struct Known {
  Eigen::Vector2f px;
  double depth;
};

/// Of a pixel without depth: the median of those of the three nearest points that have one.
double depth_nearby(const std::vector<Known>& known, const Eigen::Vector2f& px, double otherwise) {
  constexpr std::size_t kNeighbours = 3;
  if (known.size() < kNeighbours) return otherwise;
  std::array<std::pair<float, double>, kNeighbours> nearest;  // squared distance, depth
  nearest.fill({std::numeric_limits<float>::infinity(), otherwise});
  for (const Known& k : known) {
    const float distance = (k.px - px).squaredNorm();
    if (distance >= nearest.back().first) continue;
    std::size_t at = kNeighbours - 1;
    for (; at > 0 && nearest[at - 1].first > distance; --at) nearest[at] = nearest[at - 1];
    nearest[at] = {distance, k.depth};
  }
  std::array<double, kNeighbours> depths;
  for (std::size_t i = 0; i < kNeighbours; ++i) depths[i] = nearest[i].second;
  std::nth_element(depths.begin(), depths.begin() + kNeighbours / 2, depths.end());
  return depths[kNeighbours / 2];
}

}  // namespace

/// Where the tracks are seen from `T_odom_cam`: landmarks where they are, other points as deep as
/// the landmarks beside them.
std::vector<Eigen::Vector2f> Odometry::predict(const SE3& T_odom_cam) const {
  const SE3 T_cam_odom = T_odom_cam.inverse(), T_last_odom = T_odom_last_.inverse();
  const Camera& camera = calibration_.camera;
  const auto& tracks = tracker_.tracks();
  std::vector<std::optional<Eigen::Vector3d>> points;
  std::vector<Known> known;
  for (const PointTrack& track : tracks) {
    points.push_back(window_.landmark(track.id));
    if (!points.back()) continue;
    const double depth = (T_last_odom * *points.back()).z();
    if (depth > 0) known.push_back({track.px, depth});
  }
  std::vector<Eigen::Vector2f> predicted;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    predicted.push_back(tracks[i].px);
    if (!points[i]) {
      const auto ray = camera.unproject(tracks[i].px.cast<double>());
      if (!ray) continue;
      const double depth = depth_nearby(known, tracks[i].px, median_depth_m_);
      points[i] = T_odom_last_ * Eigen::Vector3d(depth * *ray);
    }
    const auto px = camera.project(T_cam_odom * *points[i]);
    if (px && camera.contains(*px, 2)) predicted.back() = px->cast<float>();
  }
  return predicted;
}

}  // namespace placegraph
