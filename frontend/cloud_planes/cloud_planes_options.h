#pragma once
#include <placegraph/graph/core/options.h>

namespace [[gnu::visibility("default")]] placegraph {

/// Method by which the planes of a cloud are found.
enum class CloudPlanesMethod {
  kCuts,     ///< super-points, normalized cuts, learned planarity
  kRansac,   ///< one plane after the other by RANSAC
  kGrowing,  ///< regions grown over points whose normals agree
};

/// Options of find_cloud_planes.
struct CloudPlanesOptions {
  CloudPlanesMethod method = CloudPlanesMethod::kCuts;
  double flatness = 0.0003;  ///< maximum deviation from a plane, as a share of the depth
  double inlier_sigmas = 3;  ///< maximum distance of a plane's points [standard deviations]
  int min_points = 50;       ///< minimum number of points of a plane
  double max_cut = 0.25;     ///< maximum value of a normalized cut that is made
  /// Minimum probability of a segment; a missed plane costs more than a false one.
  double min_probability = 0.3;
  std::uint64_t seed = 1;  ///< seed of the random samples
  void check() const;
};
void visit(OptionVisitor& field, CloudPlanesOptions& options);

}  // namespace placegraph
