#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/parallel.h>
#include <placegraph/io/exports/gltf_scene.h>
#include <placegraph/io/exports/surface_ply.h>
#include <placegraph/io/files/output_file.h>
#include <placegraph/pipeline/dense/consistent_depth.h>
#include <placegraph/pipeline/dense/depth_sources.h>
#include <placegraph/pipeline/dense/mesh_parts.h>
#include <placegraph/pipeline/dense/tsdf_surface.h>
#include <placegraph/pipeline/dense/voxel_cloud.h>
#include <placegraph/pipeline/exports/dense_export.h>
#include <placegraph/pipeline/exports/keyframe_frames.h>

#include <cmath>
#include <ctime>
#include <filesystem>

namespace placegraph {
namespace {

constexpr int kLeastPixels = 3;            ///< least number of pixels of a point
constexpr double kLeastPart_voxels = 400;  ///< least area of a part of the mesh

/// The side of the voxels that was asked for, or that fits the sensor.
double voxel_side(const DenseOutputs& outputs, const StoredMap& stored, const DepthRange& range) {
  // Side of a voxel by default: 2 cm with a depth camera, else 1 % of the median depth. Chosen.
  constexpr double kOfSensor_m = 0.02, kOfDepth = 0.01;
  if (outputs.voxel) return *outputs.voxel;
  return stored.origin.sensor == Sensor::kRgbd ? kOfSensor_m : kOfDepth * range.median;
}

/// Checks the side of the voxels by what one keyframe shows at the median depth.
void check_voxel(double side, const Camera& camera, const DepthRange& range) {
  constexpr double kBytes = 100;  // memory of a voxel on the surface
  require(std::isfinite(side) && side > 0, "--voxel: must be positive");
  const double cells =
      camera.width / camera.fx * camera.height / camera.fy * std::pow(range.median / side, 2);
  require(cells * kBytes <= static_cast<double>(kMostVoxelBytes),
          fmt::format("--voxel: {:g} is too small: one keyframe shows {:.0f} million voxels", side,
                      cells / 1e6));
}

std::unique_ptr<DepthOfKeyframe> depth_of(const StoredMap& stored, PosedImages images,
                                          const DepthRange& range) {
  switch (stored.origin.sensor) {
    case Sensor::kRgbd:
      return depth_by_sensor(std::move(images));
    case Sensor::kStereo:
      return depth_by_stereo(std::move(images), range);
    case Sensor::kMono:
      break;
  }
  return depth_by_sweep(std::move(images), range);
}

const char* name_of(Sensor sensor) {
  switch (sensor) {
    case Sensor::kRgbd:
      return "depth images";
    case Sensor::kStereo:
      return "stereo matching";
    case Sensor::kMono:
      break;
  }
  return "planes swept between keyframes";
}

void write_mesh(const std::string& path, const TriangleMesh& mesh, NumberForm form,
                const std::vector<std::string>& comments) {
  if (std::filesystem::path(path).extension() == ".glb") {
    GltfScene scene;
    scene.title = comments.front();
    scene.surface = mesh;
    write_file(path, to_gltf(scene, GltfForm::kGlb));
    return;
  }
  write_file(path, to_ply(mesh, form, comments));
}

}  // namespace

DenseSummary write_dense(const DenseOutputs& outputs, const StoredMap& stored, int component,
                         const ExportProgress& progress) {
  const std::clock_t begin = std::clock();
  const MapGeometry geometry = geometry_of(stored.map, component);
  const DepthRange range = depth_range_of(geometry);
  if (range.near == 0)
    throw NoResult((outputs.cloud.empty() ? outputs.mesh : outputs.cloud) +
                   ": the range of depths is unknown: no landmark was observed");
  const double side = voxel_side(outputs, stored, range);
  check_voxel(side, stored.origin.calibration.value().camera, range);

  ConsistentDepth depths(depth_of(stored, posed_images(stored, geometry), range));
  VoxelCloud cloud(side);
  TsdfVolume volume(side);
  for (std::size_t i = 0; i < depths.size(); ++i) {
    check_interruption();
    const KeyframeDepth depth = depths.of(i);
    if (!outputs.cloud.empty()) cloud.add(depth);
    if (!outputs.mesh.empty()) volume.add(depth);
    if (progress) progress(i + 1, depths.size());
  }

  DenseSummary summary{.source = name_of(stored.origin.sensor),
                       .keyframes = depths.size(),
                       .voxel = side,
                       .metric = stored.map.metric,
                       .points = {},
                       .vertices = {},
                       .triangles = {},
                       .cpu_s = 0};
  const std::vector<std::string> comments = {
      fmt::format("surfaces of component {} of a map by placegraph", component),
      stored.map.metric ? "lengths in metres" : "lengths at an arbitrary scale"};
  const std::vector<DensePoint> points = cloud.points(kLeastPixels);
  if (!outputs.cloud.empty() && points.empty())
    throw NoResult(outputs.cloud + ": no depth on which keyframes agree");
  TriangleMesh mesh = surface_of(volume);
  remove_small_parts(mesh, kLeastPart_voxels * side * side);
  if (!outputs.mesh.empty() && mesh.faces.empty())
    throw NoResult(outputs.mesh + ": no depth on which keyframes agree");
  if (!outputs.cloud.empty()) {
    write_file(outputs.cloud, to_ply(points, outputs.form, comments));
    summary.points = points.size();
  }
  if (!outputs.mesh.empty()) {
    write_mesh(outputs.mesh, mesh, outputs.form, comments);
    summary.vertices = mesh.positions.size();
    summary.triangles = mesh.faces.size();
  }
  summary.cpu_s = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  return summary;
}

}  // namespace placegraph
