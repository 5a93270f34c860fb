#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/ransac_options.h>

#include <cstdint>

namespace [[gnu::visibility("default")]] placegraph {

/// How a particle's velocity is damped.
enum class SwarmDamping {
  kConstriction,  ///< chi = 2 / |2 - phi - sqrt(phi^2 - 4 phi)|, phi = 4.1 (Clerc & Kennedy 2002)
  kInertia,       ///< weight from 0.9 to 0.4 over the run, c1 = c2 = 1.7 (Shi & Eberhart 1998)
};

/// Whose best point draws a particle.
enum class SwarmTopology {
  kGlobal,  ///< that of all
  kRing,    ///< of itself and its two neighbours by index: slower to agree, harder to fool
};

struct SwarmOptions {
  SwarmDamping damping = SwarmDamping::kConstriction;
  SwarmTopology topology = SwarmTopology::kRing;
  int particles = 40;
  int generations = 40;
  int stagnation = 12;     ///< generations without a better best point that end the search
  double max_speed = 0.8;  ///< per coordinate and generation, in standard deviations of the start
  double bound = 3;        ///< coordinates stay within, in the same unit; they are reflected there
  std::uint64_t seed = 1;
  int threads = 1;  ///< the result does not depend on it
  void check() const;
};
void visit(OptionVisitor& field, SwarmOptions& options);

struct DirectMotionOptions {
  int levels = 4;
  int samples = 1500;       ///< of all planes together, per level
  int min_samples = 150;    ///< of the finest level, in view
  int iterations = 12;      ///< per level
  double converged = 0.01;  ///< a step that moves the samples by less on average ends a level [px]
  double kernel_width = 4.685;     ///< of Tukey's weights [standard deviations of the residuals]
  double min_visible_share = 0.3;  ///< of the samples
  double min_agreement = 0.5;      ///< correlation of what is seen and what is predicted
  double min_inlier_share = 0.4;   ///< of the samples in view
  int tile_px = 32;  ///< residuals within a tile may be correlated in any way, see the covariance
  SwarmOptions swarm{.particles = 48, .generations = 40};
  void check() const;
};
void visit(OptionVisitor& field, DirectMotionOptions& options);

struct DepthPlanesOptions {
  int cell_px = 8;           ///< side of the cells that planes are grown over
  int step_px = 2;           ///< between the pixels that are looked at
  double flatness = 0.002;   ///< what a plane may bend, as a share of the depth
  double min_share = 0.02;   ///< of the image's cells, for a plane
  int max_planes = 8;        ///< the largest
  double max_sigma_deg = 1;  ///< of the normal, to be of use
  /// What all planes of a camera may be off by beyond what their residuals tell: its depths are
  /// bent and scaled, which a plane follows.
  double floor_deg = 0.1;
  double floor_distance = 0.002;  ///< as a share of the distance
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, DepthPlanesOptions& options);

struct GroundPlaneOptions {
  /// The part of the ground that is looked at, in camera heights: it must be road, and of one lane,
  /// as roads are arched.
  double near_heights = 2.5, far_heights = 12, half_width_heights = 1.4;
  int step_px = 3;  ///< grid of samples in the reference image
  int pyramid_levels = 3;
  int iterations = 12;             ///< per level
  double pixel_correlation = 0.1;  ///< share of the samples that counts as independent
  double min_zncc = 0.5;           ///< agreement of the warped patches below which nothing is said
  int min_samples = 400;
  void check() const;
};
void visit(OptionVisitor& field, GroundPlaneOptions& options);

struct InverseDepthPlaneOptions {
  RansacOptions ransac{.max_iterations = 200, .confidence = 0.999, .min_inliers = 25};
  double threshold_sigmas = 3;      ///< inliers lie this close
  double max_sigma_deg = 3;         ///< of the normal, to be of use
  double max_sigma_distance = 0.1;  ///< of the distance, as a share of it
  void check() const;
};
void visit(OptionVisitor& field, InverseDepthPlaneOptions& options);

struct DominantSurfaceOptions {
  InverseDepthPlaneOptions fit;
  /// The road that is looked at first, in distances of the surface; the other regions lie in it or
  /// beside it.
  double near_heights = 2, far_heights = 12, half_width_heights = 1.5;
  int pixels = 400;                      ///< asked for in one region
  double min_share = 0.4;                ///< of a region's pixels that must lie on the surface
  double mounting_sigma_deg = 5;         ///< pitch and roll before anything was seen
  double mounting_sigma_distance = 0.3;  ///< height before anything was seen, as a share of it
  double pitching_sigma_deg = 0.3;       ///< pitch and roll from one look to the next
  double distance_drift = 0.005;         ///< height from one look to the next, as a share of it
  double slope_sigma_deg = 2;            ///< pitch and roll where the slope may have changed
  void check() const;
};
void visit(OptionVisitor& field, DominantSurfaceOptions& options);

}  // namespace placegraph
