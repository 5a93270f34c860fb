#pragma once
#include <placegraph/frontend/features/feature_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/ransac_options.h>

#include <cstdint>

namespace [[gnu::visibility("default")]] placegraph {

/// Damping of a particle's velocity.
enum class SwarmDamping {
  kConstriction,  ///< chi = 2 / |2 - phi - sqrt(phi^2 - 4 phi)|, phi = 4.1 (Clerc & Kennedy 2002)
  kInertia,  ///< weight from 0.9 to 0.4 over the generations, c1 = c2 = 1.7 (Shi & Eberhart 1998)
};

/// Set of particles whose best point attracts a particle.
enum class SwarmTopology {
  kGlobal,  ///< all particles
  kRing,  ///< the particle and its two neighbours by index: slower convergence, fewer false optima
};

/// Particle swarm search (Kennedy & Eberhart 1995) around an initial estimate.
///
/// Coordinates are in standard deviations of the initial estimate.
struct SwarmOptions {
  SwarmDamping damping = SwarmDamping::kConstriction;  ///< damping of the velocities
  /// Set of particles whose best point attracts a particle.
  SwarmTopology topology = SwarmTopology::kRing;
  int particles = 40;    ///< size of the swarm
  int generations = 40;  ///< maximum number of moves of each particle
  int stagnation = 12;   ///< number of generations without a better best point that ends the search
  double bound = 3;      ///< maximum absolute value of a coordinate; particles are reflected there
  std::uint64_t seed = 1;  ///< seed of the random streams, one per particle
  int threads = 1;         ///< number of threads; the result does not depend on it
  void check() const;
};
void visit(OptionVisitor& field, SwarmOptions& options);

/// Motion between two images by direct alignment of the grey values of several planes.
struct DirectMotionOptions {
  int levels = 4;      ///< levels of the image pyramid, coarse to fine
  int samples = 1500;  ///< number of samples of all planes together, per level
  /// Search without an initial motion.
  SwarmOptions swarm{.particles = 48, .generations = 40};
  void check() const;
};
void visit(OptionVisitor& field, DirectMotionOptions& options);

/// Planes in a depth image, grown over cells.
struct DepthPlanesOptions {
  int cell_px = 8;          ///< side of the cells that planes are grown over
  double min_share = 0.02;  ///< minimum share of the image's cells on a plane
  int max_planes = 8;       ///< maximum number of planes; the largest ones are kept
  /// Minimum standard deviation of a normal, beyond the residuals' covariance: the depths of a
  /// camera have systematic bend and scale errors, which its planes share.
  double floor_deg = 0.1;
  /// Minimum relative standard deviation of the distance of a plane.
  double floor_distance = 0.002;
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, DepthPlanesOptions& options);

/// The ground plane from two images of known motion by direct alignment.
struct GroundPlaneOptions {
  /// Region of the ground that is aligned, ahead of the camera, in camera heights. It must contain
  /// only the road, and only one lane, as roads are arched.
  double near_heights = 2.5, far_heights = 12, half_width_heights = 1.4;
  void check() const;
};
void visit(OptionVisitor& field, GroundPlaneOptions& options);

/// A plane through pixels of known inverse depth.
struct InverseDepthPlaneOptions {
  /// Three-pixel hypotheses.
  RansacOptions ransac{.max_iterations = 200, .confidence = 0.999, .min_inliers = 25};
  double max_sigma_deg = 3;  ///< maximum standard deviation of the normal
  void check() const;
};
void visit(OptionVisitor& field, InverseDepthPlaneOptions& options);

/// The surface that a camera moves over, followed by a filter of pitch, roll and height.
struct DominantSurfaceOptions {
  InverseDepthPlaneOptions fit;  ///< the plane through the depths of one region
  /// Region ahead of the camera that is tried first, in distances of the surface; other regions are
  /// in it or beside it.
  double near_heights = 2, far_heights = 12, half_width_heights = 1.5;
  void check() const;
};
void visit(OptionVisitor& field, DominantSurfaceOptions& options);

/// Options of the estimation of a plane's normal from several views.
struct PlaneNormalOptions {
  int views = 24;            ///< maximum number of views kept
  double apart_px = 4;       ///< minimum distance of a view from every kept one, for it to be kept
  double sigma_px = 0.3;     ///< minimum standard deviation of a corner
  double max_sigma_deg = 5;  ///< maximum standard deviation of the normal
  double distinct_deg = 8;   ///< readings closer than this count as one
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, PlaneNormalOptions& options);

/// Options of the motion between two views of several planes.
struct MotionFromPlanesOptions {
  int max_iterations = 30;
  /// Readings up to this far below the best in log-likelihood are kept.
  double ambiguity_log_ratio = 6;
  void check() const;
};
void visit(OptionVisitor& field, MotionFromPlanesOptions& options);

/// Options of the template finder.
struct TemplateFinderOptions {
  WideMatcherOptions features;  ///< its geometric options are not used
  double inlier_px = 3;         ///< maximum symmetric transfer error of an inlier
  RansacOptions ransac{2000, 0.999, 8};
  int places = 3;  ///< maximum number of proposals; each uses the matches left by the previous ones
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, TemplateFinderOptions& options);

}  // namespace placegraph
