#pragma once
#include <placegraph/graph/core/options.h>

namespace placegraph {

enum class CloudPlanesMethod {
  kCuts,     ///< super-points, normalized cuts, learned planarity
  kRansac,   ///< one plane after the other by RANSAC
  kGrowing,  ///< regions grown over points whose normals agree
};

struct CloudPlanesOptions {
  CloudPlanesMethod method = CloudPlanesMethod::kCuts;
  double flatness = 0.0003;      ///< what a plane may bend, as a share of the depth
  double inlier_sigmas = 3;      ///< points of a plane are this near
  int min_points = 50;           ///< fewer are no plane
  double max_cut = 0.25;         ///< normalized cuts above it are not made
  double min_probability = 0.3;  ///< of a segment; a lost plane costs more than a false one
  std::uint64_t seed = 1;        ///< of the random samples
  void check() const;
};
void visit(OptionVisitor& field, CloudPlanesOptions& options);

}  // namespace placegraph
