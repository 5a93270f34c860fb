#include <placegraph/graph/map_index.h>
#include <placegraph/pipeline/map/map_geometry.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace placegraph {
namespace {

/// The largest standard deviation of a covariance.
double worst_sigma(const Eigen::Matrix3d& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(covariance, Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, eigen.eigenvalues()[2]));
}

}  // namespace

MapGeometry geometry_of(const Map& map, std::optional<int> component) {
  const MapIndex index(map);
  MapGeometry geometry;
  std::unordered_map<KeyframeId, Sim3> S_map_keyframe;
  for (const Keyframe& keyframe : map.keyframes) {
    const auto at = index.find(keyframe.id);
    if (!at || (component && at->component != *component)) continue;
    const Sim3 S = S_map_keyframe.emplace(keyframe.id, at->S_map_keyframe()).first->second;
    geometry.keyframes.push_back({&keyframe, rigid_part(S)});
  }
  for (const PointLandmark& landmark : map.landmarks) {
    const auto anchor = S_map_keyframe.find(landmark.keyframe);
    if (anchor == S_map_keyframe.end()) continue;
    PlacedLandmark& placed = geometry.landmarks.emplace_back();
    placed.id = landmark.id;
    placed.keyframe = landmark.keyframe;
    placed.p_map = anchor->second * landmark.point_cam;
    placed.rgb = landmark.rgb;
    if (landmark.covariance)
      placed.sigma = anchor->second.scale() * worst_sigma(*landmark.covariance);
  }
  return geometry;
}

}  // namespace placegraph
