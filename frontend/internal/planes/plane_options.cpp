#include <placegraph/frontend/planes/plane_options.h>
#include <placegraph/graph/core/error.h>

namespace placegraph {

void SwarmOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, SwarmOptions& o) {
  field.choice("damping", o.damping, {"constriction", "inertia"}, "how velocities are damped");
  field.choice("topology", o.topology, {"global", "ring"}, "whose best point draws a particle");
  field("particles", o.particles, "size of the swarm", {3, 10000});
  field("generations", o.generations, "moves of each particle at most", {1, 10000});
  field("stagnation", o.stagnation, "generations without progress that end it", {1, 10000});
  field("max_speed", o.max_speed, "of a coordinate, in standard deviations of the start",
        {0.001, 100});
  field("bound", o.bound, "of a coordinate, in standard deviations of the start", {0.1, 100});
  field("seed", o.seed, "of the random streams");
  field("threads", o.threads, "threads; the result does not depend on it", {1, 256});
}

void DirectMotionOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, DirectMotionOptions& o) {
  field("levels", o.levels, "of the pyramid, coarse to fine", {1, 8});
  field("samples", o.samples, "of all planes together, per level", {100, 1000000});
  field("min_samples", o.min_samples, "of the finest level, in view", {20, 1000000});
  field("iterations", o.iterations, "at most, per level", {1, 1000});
  field("converged", o.converged, "mean step that ends a level [px]", {1e-6, 1});
  field("kernel_width", o.kernel_width, "of the weights, in standard deviations", {0.1, 100});
  field("min_visible_share", o.min_visible_share, "of the samples", {0.05, 1});
  field("min_agreement", o.min_agreement, "correlation below which it is no match", {-1, 1});
  field("min_inlier_share", o.min_inlier_share, "of the samples in view", {0, 1});
  field("tile_px", o.tile_px, "residuals within a tile may be correlated", {4, 1000});
  field.group("swarm", o.swarm, "search where no start is known");
}

void visit(OptionVisitor& field, DepthPlanesOptions& o) {
  field("cell_px", o.cell_px, "side of the cells that planes are grown over", {4, 64});
  field("step_px", o.step_px, "between the pixels that are looked at", {1, 16});
  field("flatness", o.flatness, "what a plane may bend, as a share of the depth", {0, 0.1});
  field("min_share", o.min_share, "of the image, for a plane", {0, 1});
  field("max_planes", o.max_planes, "of an image, the largest", {1, 100});
  field("max_sigma_deg", o.max_sigma_deg, "of the normal, to be of use", {0.01, 30});
  field("floor_deg", o.floor_deg, "what normals may be off by beyond what their residuals tell",
        {1e-3, 10});
  field("floor_distance", o.floor_distance, "the same of distances, as a share", {1e-5, 0.5});
}

void GroundPlaneOptions::check() const {
  check_ranges(*this);
  require(near_heights < far_heights, "near_heights: must be below far_heights");
}

void visit(OptionVisitor& field, GroundPlaneOptions& o) {
  field("near_heights", o.near_heights, "nearest road looked at, in camera heights", {0.5, 100});
  field("far_heights", o.far_heights, "farthest road looked at, in camera heights", {1, 200});
  field("half_width_heights", o.half_width_heights,
        "half the width of the road looked at, in camera heights", {0.2, 50});
  field("step_px", o.step_px, "grid of samples", {1, 32});
  field("pyramid_levels", o.pyramid_levels, "levels, coarse to fine", {1, 6});
  field("iterations", o.iterations, "Gauss-Newton steps per level", {1, 100});
  field("pixel_correlation", o.pixel_correlation,
        "share of the samples that counts as independent, for the covariance", {0.001, 1});
  field("min_zncc", o.min_zncc, "agreement below which nothing is said", {-1, 1});
  field("min_samples", o.min_samples, "fewest samples seen in both images", {50, 1000000});
}

void InverseDepthPlaneOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, InverseDepthPlaneOptions& o) {
  field.group("ransac", o.ransac, "three-pixel hypotheses");
  field("threshold_sigmas", o.threshold_sigmas, "inliers lie this close", {0.5, 20});
  field("max_sigma_deg", o.max_sigma_deg, "of the normal, to be of use", {0.01, 45});
  field("max_sigma_distance", o.max_sigma_distance, "of the distance, as a share of it", {1e-3, 1});
}

void DominantSurfaceOptions::check() const {
  check_ranges(*this);
  require(near_heights < far_heights, "near_heights: must be below far_heights");
}

void visit(OptionVisitor& field, DominantSurfaceOptions& o) {
  field.group("fit", o.fit, "plane through the depths of a region");
  field("near_heights", o.near_heights, "nearest place looked at, in distances", {0.5, 100});
  field("far_heights", o.far_heights, "farthest place looked at, in distances", {1, 200});
  field("half_width_heights", o.half_width_heights, "half the width looked at, in distances",
        {0.2, 50});
  field("pixels", o.pixels, "asked for in one region", {50, 100000});
  field("min_share", o.min_share, "of a region's pixels that must lie on it", {0, 1});
  field("mounting_sigma_deg", o.mounting_sigma_deg, "pitch and roll before anything was seen",
        {0.01, 45});
  field("mounting_sigma_distance", o.mounting_sigma_distance,
        "height before anything was seen, as a share of it", {1e-3, 1});
  field("pitching_sigma_deg", o.pitching_sigma_deg, "pitch and roll from look to look", {0, 45});
  field("distance_drift", o.distance_drift, "height from look to look, as a share of it", {0, 1});
  field("slope_sigma_deg", o.slope_sigma_deg, "pitch and roll where the slope may have changed",
        {0, 45});
}

}  // namespace placegraph
