#pragma once
#include <placegraph/backend/factor_graph/bundle_adjustment.h>

#include <string>

namespace placegraph::apps {

struct BundleArguments {
  std::string in;               ///< problem in BAL format, or folder of a COLMAP model
  std::string out;              ///< file or folder for the adjusted problem; empty: none
  std::string kernel = "none";  ///< one of robust_kernel_names()
  BundleOptions options;        ///< the kind of the kernel is set by `kernel`
  bool force = false;           ///< overwrite `out`
};

struct BundleResult {
  std::string in, out;
  std::size_t cameras = 0, points = 0, observations = 0;
  std::size_t unused_cameras = 0, unused_points = 0;  ///< without an observation
  BundleReport report;
  double cpu_ms = 0, wall_ms = 0;
};

/// Reads a problem, adjusts it and writes it: `placegraph graph bundle`.
/// Cameras and points without an observation are written as they are.
/// Throws ArgumentError, FileError, and NoResult if the problem has no solution.
BundleResult bundle(const BundleArguments& arguments);

/// Three lines of text, and one on cameras and points without an observation.
std::string to_text(const BundleResult& result);
std::string to_json(const BundleResult& result);

}  // namespace placegraph::apps
