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

/// Whose best point attracts a particle.
enum class SwarmTopology {
  kGlobal,  ///< that of all
  kRing,    ///< of itself and its two neighbours by index: slower to agree, harder to fool
};

/// Particle swarm search (Kennedy & Eberhart 1995) about a start.
///
/// Coordinates are in standard deviations of the start.
struct SwarmOptions {
  SwarmDamping damping = SwarmDamping::kConstriction;  ///< how velocities are damped
  SwarmTopology topology = SwarmTopology::kRing;       ///< whose best point attracts a particle
  int particles = 40;                                  ///< size of the swarm
  int generations = 40;                                ///< most moves of each particle
  int stagnation = 12;     ///< generations without a better best point that end the search
  double max_speed = 0.8;  ///< most change of a coordinate in one generation
  double bound = 3;  ///< largest absolute value of a coordinate; particles are reflected there
  std::uint64_t seed = 1;  ///< of the random streams, one per particle
  int threads = 1;         ///< the result does not depend on it
  void check() const;
};
void visit(OptionVisitor& field, SwarmOptions& options);

/// Motion between two images by direct alignment of the grey values of several planes.
struct DirectMotionOptions {
  int levels = 4;           ///< levels of the image pyramid, coarse to fine
  int samples = 1500;       ///< samples of all planes together, per level
  int min_samples = 150;    ///< least number of samples in view on the finest level
  int iterations = 12;      ///< most iterations per level
  double converged = 0.01;  ///< mean displacement of the samples by a step that ends a level [px]
  double kernel_width = 4.685;     ///< of Tukey's weights [standard deviations of the residuals]
  double min_visible_share = 0.3;  ///< least share of the samples that is in view
  double min_agreement = 0.5;      ///< least correlation of observed and predicted grey values
  double min_inlier_share = 0.4;   ///< least share of inliers among the samples in view
  /// Side of the tiles within which residuals may be correlated; the covariance allows for it.
  int tile_px = 32;
  /// Search where no start is known.
  SwarmOptions swarm{.particles = 48, .generations = 40};
  void check() const;
};
void visit(OptionVisitor& field, DirectMotionOptions& options);

/// Planes in a depth image, grown over cells.
struct DepthPlanesOptions {
  int cell_px = 8;           ///< side of the cells that planes are grown over
  int step_px = 2;           ///< distance of the pixels used; at most half of cell_px
  double flatness = 0.002;   ///< largest deviation from a plane, as a share of the depth
  double min_share = 0.02;   ///< least share of the image's cells on a plane
  int max_planes = 8;        ///< most planes, the largest ones
  double max_sigma_deg = 1;  ///< largest standard deviation of the normal of a plane
  /// Least standard deviation of a normal, beyond what residuals tell: the depths of a camera are
  /// bent and scaled, which its planes follow.
  double floor_deg = 0.1;
  double floor_distance = 0.002;  ///< the same of the distance, as a share of it
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, DepthPlanesOptions& options);

/// The ground plane from two images of known motion by direct alignment.
struct GroundPlaneOptions {
  /// The part of the ground that is aligned, ahead of the camera, in camera heights: it must be
  /// road, and of one lane, as roads are arched.
  double near_heights = 2.5, far_heights = 12, half_width_heights = 1.4;
  int step_px = 3;                 ///< distance of neighbouring samples in the reference image
  int pyramid_levels = 3;          ///< levels of the image pyramid, coarse to fine
  int iterations = 12;             ///< Gauss-Newton iterations per level
  double pixel_correlation = 0.1;  ///< share of the samples that counts as independent
  double min_zncc = 0.5;  ///< least correlation of the aligned samples; below, there is no result
  int min_samples = 400;  ///< least number of samples seen in both images
  void check() const;
};
void visit(OptionVisitor& field, GroundPlaneOptions& options);

/// A plane through pixels of known inverse depth.
struct InverseDepthPlaneOptions {
  /// Three-pixel hypotheses.
  RansacOptions ransac{.max_iterations = 200, .confidence = 0.999, .min_inliers = 25};
  double threshold_sigmas = 3;      ///< largest residual of an inlier, in standard deviations
  double max_sigma_deg = 3;         ///< largest standard deviation of the normal
  double max_sigma_distance = 0.1;  ///< largest relative standard deviation of the distance
  void check() const;
};
void visit(OptionVisitor& field, InverseDepthPlaneOptions& options);

/// The surface that a camera moves over, followed by a filter of pitch, roll and height.
struct DominantSurfaceOptions {
  InverseDepthPlaneOptions fit;  ///< the plane through the depths of one region
  /// The region ahead of the camera that is tried first, in distances of the surface; other regions
  /// lie in it or beside it.
  double near_heights = 2, far_heights = 12, half_width_heights = 1.5;
  int pixels = 400;                      ///< pixels in one region whose depth is measured
  double min_share = 0.4;                ///< least share of a region's pixels on the surface
  double mounting_sigma_deg = 5;         ///< standard deviation of pitch and roll at first
  double mounting_sigma_distance = 0.3;  ///< relative standard deviation of the height at first
  double pitching_sigma_deg = 0.3;       ///< random walk of pitch and roll from image to image
  double distance_drift = 0.005;         ///< relative random walk of the height
  double slope_sigma_deg = 2;  ///< that of pitch and roll after a plane that contradicts the filter
  void check() const;
};
void visit(OptionVisitor& field, DominantSurfaceOptions& options);

}  // namespace placegraph
