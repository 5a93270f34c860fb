#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "apps/graph/bundle.h"

namespace placegraph::apps {

struct ColmapBundleResult {
  std::string in, out;
  std::size_t images = 0, points = 0, observations = 0;
  double cost_initial = 0, cost = 0;         ///< half the sum of rho(squared error)
  double error_before_px = 0, error_px = 0;  ///< mean reprojection errors
  int iterations = 0;
  std::vector<std::uint32_t> unused_cameras;  ///< ids of cameras that no image has
  double cpu_ms = 0, wall_ms = 0;
};

/// Reads a COLMAP model from the folder `in`, adjusts its poses and points, and writes it into the
/// folder `out` in the same form: `placegraph graph bundle FOLDER`.
/// Throws ArgumentError, FileError, and NoResult if the model has no solution.
ColmapBundleResult colmap_bundle(const BundleArguments& arguments);

/// Three lines of text, and one on cameras that no image has.
std::string to_text(const ColmapBundleResult& result);
std::string to_json(const ColmapBundleResult& result);

}  // namespace placegraph::apps
