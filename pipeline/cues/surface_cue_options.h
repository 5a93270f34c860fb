#pragma once
#include <placegraph/frontend/align/direct_motion.h>
#include <placegraph/frontend/planes/dominant_surface.h>

namespace placegraph {

struct SurfaceCueOptions {
  DominantSurfaceOptions surface;  ///< the ground under a vehicle or robot
  InverseDepthPlaneOptions planes{.ransac = {.max_iterations = 100, .min_inliers = 30}};
  DirectMotionOptions align;
  int depths = 800;  ///< asked for over the whole image, where planes are sought
  int max_planes = 5;
  double min_plane_share = 0.06;     ///< of the depths, for a plane
  double evenness_distance = 0.005;  ///< no surface is known better: as a share of its distance
  double evenness_deg = 0.1;         ///< and its normal
  double nodding_deg = 0.4;          ///< of a vehicle about its mean pitch and roll, for one eye
  double sigma_height = 0.01;        ///< of the height of one eye, as a share of it
  double keyframe_share = 0.6;       ///< of the surfaces in view below which a keyframe is due
  double max_disagreement = 5;       ///< of forward and backward motion [standard deviations]
  void check() const;
};
void visit(OptionVisitor& field, SurfaceCueOptions& options);

}  // namespace placegraph
