#pragma once
#include <cstddef>
#include <functional>
#include <optional>
#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// Receives how many keyframes of a total are done.
using ExportProgress = std::function<void(std::size_t done, std::size_t total)>;

/// Model that was written for COLMAP.
struct ColmapSummary {
  std::size_t keyframes = 0;     ///< number of images
  std::size_t points = 0;        ///< number of points
  std::size_t kept = 0;          ///< number of their observations
  std::size_t observations = 0;  ///< number of observations of the component's landmarks
  double error_before_px = 0;    ///< mean reprojection error before the adjustment
  double error_px = 0;           ///< mean reprojection error of what was kept
  double views = 0;              ///< mean number of observations of a point
  double lens_k1 = 0;            ///< distortion of the named images that the camera does not have
};

/// Dense cloud and mesh that were written.
struct DenseSummary {
  std::string source;                              ///< where the depth is from
  std::size_t keyframes = 0;                       ///< number of keyframes with depth
  double voxel = 0;                                ///< side of the voxels
  bool metric = false;                             ///< whether it is in metres
  std::optional<std::size_t> points;               ///< number of points of the cloud
  std::optional<std::size_t> vertices, triangles;  ///< numbers of those of the mesh
  double cpu_s = 0;                                ///< CPU time [s]
};

/// The figures of a model for COLMAP in one line.
std::string to_text(const ColmapSummary& summary);
/// The figures of cloud and mesh in one line.
std::string to_text(const DenseSummary& summary);

}  // namespace placegraph
