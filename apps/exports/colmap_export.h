#pragma once
#include <placegraph/io/exports/ply_points.h>
#include <placegraph/io/map/stored_map.h>

#include <cstddef>
#include <string>

namespace placegraph::apps {

/// What was written for COLMAP.
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

/// Adjusts a component of a map and writes cameras, images and points3D into a folder.
/// Files of the other form there are removed. `undistorted`: as KeyframeImages. Throws FileError if
/// the sequence or the folder cannot be used, NoResult if no point is left.
ColmapSummary write_colmap(const std::string& folder, const StoredMap& stored, int component,
                           NumberForm form, const std::string& undistorted = "");

/// One line.
std::string to_text(const ColmapSummary& summary);

}  // namespace placegraph::apps
