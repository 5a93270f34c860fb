#include <fmt/format.h>
#include <placegraph/graph/core/median.h>
#include <placegraph/pipeline/exports/gltf_export.h>
#include <placegraph/pipeline/map/map_geometry.h>

namespace placegraph {
namespace {

/// The polylines of frames that follow each other, each of two positions or more.
GltfScene::Lines trajectory_lines(const Trajectory& trajectory) {
  GltfScene::Lines lines{.name = "trajectory", .rgb = {0.85, 0.15, 0.1}, .strips = {}, .pairs = {}};
  std::vector<Eigen::Vector3d> strip;
  const auto end_strip = [&] {
    if (strip.size() >= 2) lines.strips.push_back(strip);
    strip.clear();
  };
  for (const StampedPose& pose : trajectory.poses) {
    if (pose.T_world_body)
      strip.emplace_back(pose.T_world_body->translation());
    else
      end_strip();
  }
  end_strip();
  return lines;
}

/// Depth of the drawn pyramids: the usual distance between neighbouring keyframes.
double pyramid_depth(const std::vector<PosedKeyframe>& keyframes) {
  std::vector<double> steps;
  for (std::size_t i = 0; i + 1 < keyframes.size(); ++i)
    steps.push_back(
        (keyframes[i + 1].T_map_cam.translation() - keyframes[i].T_map_cam.translation()).norm());
  const double step = steps.empty() ? 0 : median_of(steps);
  return step > 0 ? step : 0.1;
}

/// The edges of the pyramids of view.
GltfScene::Lines view_pyramids(const std::vector<PosedKeyframe>& keyframes, const Camera& camera) {
  GltfScene::Lines lines{.name = "keyframes", .rgb = {0.1, 0.35, 0.8}, .strips = {}, .pairs = {}};
  const double depth = pyramid_depth(keyframes);
  const double right = camera.width - 0.5, bottom = camera.height - 0.5;
  const std::array<Eigen::Vector2d, 4> corners_px = {
      Eigen::Vector2d(-0.5, -0.5), {right, -0.5}, {right, bottom}, {-0.5, bottom}};
  for (const PosedKeyframe& posed : keyframes) {
    std::array<Eigen::Vector3d, 4> corners;
    for (std::size_t i = 0; i < 4; ++i)
      corners[i] = posed.T_map_cam *
                   Eigen::Vector3d((corners_px[i][0] - camera.cx) / camera.fx * depth,
                                   (corners_px[i][1] - camera.cy) / camera.fy * depth, depth);
    for (std::size_t i = 0; i < 4; ++i) {
      lines.pairs.push_back({posed.T_map_cam.translation(), corners[i]});
      lines.pairs.push_back({corners[i], corners[(i + 1) % 4]});
    }
  }
  return lines;
}

}  // namespace

std::string map_gltf(const StoredMap& stored, int component, GltfForm form) {
  const MapGeometry geometry = geometry_of(stored.map, component);
  GltfScene scene;
  scene.title = fmt::format("component {} of a map, {}", component,
                            stored.map.metric ? "metres" : "arbitrary scale");
  for (const PlacedLandmark& landmark : geometry.landmarks) {
    scene.points.positions.push_back(landmark.p_map);
    scene.points.colours.push_back(landmark.rgb.value_or(kUnknownColour));
  }
  scene.lines.push_back(trajectory_lines(stored.map.trajectory_optimized(component)));
  scene.lines.push_back(
      view_pyramids(geometry.keyframes, stored.origin.calibration.value().camera));
  return to_gltf(scene, form);
}

}  // namespace placegraph
