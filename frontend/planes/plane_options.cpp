#include <placegraph/frontend/planes/plane_options.h>
#include <placegraph/graph/core/error.h>

namespace placegraph {

void SwarmOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, SwarmOptions& o) {
  field.choice("damping", o.damping, {"constriction", "inertia"}, "damping of the velocities");
  field.choice("topology", o.topology, {"global", "ring"},
               "set of particles whose best point attracts a particle");
  field("particles", o.particles, "size of the swarm", {3, 10000});
  field("generations", o.generations, "maximum number of moves of each particle", {1, 10000});
  field("stagnation", o.stagnation, "generations without a better best point that end the search",
        {1, 10000});
  field("max_speed", o.max_speed,
        "maximum change of a coordinate in one generation [sigma of the start]", {0.001, 100});
  field("bound", o.bound, "maximum absolute value of a coordinate [sigma of the start]",
        {0.1, 100});
  field("seed", o.seed, "seed of the random streams");
  field("threads", o.threads, "number of threads; the result does not depend on it", {1, 256});
}

void DirectMotionOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, DirectMotionOptions& o) {
  field("levels", o.levels, "levels of the image pyramid, coarse to fine", {1, 8});
  field("samples", o.samples, "number of samples of all planes together, per level",
        {100, 1000000});
  field("min_samples", o.min_samples, "minimum number of samples in view on the finest level",
        {20, 1000000});
  field("iterations", o.iterations, "maximum number of iterations per level", {1, 1000});
  field("converged", o.converged,
        "mean displacement of the samples by a step that ends a level [px]", {1e-6, 1});
  field("kernel_width", o.kernel_width, "width of Tukey's weights [sigma of the residuals]",
        {0.1, 100});
  field("min_visible_share", o.min_visible_share, "minimum share of the samples that is in view",
        {0.05, 1});
  field("min_agreement", o.min_agreement,
        "minimum correlation of observed and predicted grey values", {-1, 1});
  field("min_inlier_share", o.min_inlier_share,
        "minimum share of inliers among the samples in view", {0, 1});
  field("tile_px", o.tile_px, "side of the tiles within which residuals may be correlated",
        {4, 1000});
  field.group("swarm", o.swarm, "search without an initial motion");
}

void visit(OptionVisitor& field, DepthPlanesOptions& o) {
  field("cell_px", o.cell_px, "side of the cells that planes are grown over", {4, 64});
  field("step_px", o.step_px, "distance of the pixels used", {1, 16});
  field("flatness", o.flatness, "maximum deviation from a plane, as a share of the depth",
        {0, 0.1});
  field("min_share", o.min_share, "minimum share of the image's cells on a plane", {0, 1});
  field("max_planes", o.max_planes, "maximum number of planes; the largest ones are kept",
        {1, 100});
  field("max_sigma_deg", o.max_sigma_deg, "maximum standard deviation of the normal of a plane",
        {0.01, 30});
  field("floor_deg", o.floor_deg,
        "minimum standard deviation of a normal, beyond the residuals' covariance", {1e-3, 10});
  field("floor_distance", o.floor_distance,
        "minimum relative standard deviation of the distance of a plane", {1e-5, 0.5});
}

void GroundPlaneOptions::check() const {
  check_ranges(*this);
  require(near_heights < far_heights, "near_heights: must be below far_heights");
}

void visit(OptionVisitor& field, GroundPlaneOptions& o) {
  field("near_heights", o.near_heights, "nearest ground that is aligned [camera heights]",
        {0.5, 100});
  field("far_heights", o.far_heights, "farthest ground that is aligned [camera heights]", {1, 200});
  field("half_width_heights", o.half_width_heights,
        "half the width of the ground that is aligned [camera heights]", {0.2, 50});
  field("step_px", o.step_px, "distance of neighbouring samples in the reference image", {1, 32});
  field("pyramid_levels", o.pyramid_levels, "levels of the image pyramid, coarse to fine", {1, 6});
  field("iterations", o.iterations, "Gauss-Newton iterations per level", {1, 100});
  field("pixel_correlation", o.pixel_correlation,
        "share of the samples that counts as independent, for the covariance", {0.001, 1});
  field("min_zncc", o.min_zncc,
        "minimum correlation of the aligned samples; there is no result below it", {-1, 1});
  field("min_samples", o.min_samples, "minimum number of samples seen in both images",
        {50, 1000000});
}

void InverseDepthPlaneOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, InverseDepthPlaneOptions& o) {
  field.internal().group("ransac", o.ransac, "three-pixel hypotheses");
  field("threshold_sigmas", o.threshold_sigmas,
        "maximum residual of an inlier, in standard deviations", {0.5, 20});
  field("max_sigma_deg", o.max_sigma_deg, "maximum standard deviation of the normal", {0.01, 45});
  field("max_sigma_distance", o.max_sigma_distance,
        "maximum relative standard deviation of the distance", {1e-3, 1});
}

void DominantSurfaceOptions::check() const {
  check_ranges(*this);
  require(near_heights < far_heights, "near_heights: must be below far_heights");
}

void visit(OptionVisitor& field, DominantSurfaceOptions& o) {
  field.group("fit", o.fit, "plane through the depths of one region");
  field("near_heights", o.near_heights,
        "near end of the region tried first [distances of the surface]", {0.5, 100});
  field("far_heights", o.far_heights,
        "far end of the region tried first [distances of the surface]", {1, 200});
  field("half_width_heights", o.half_width_heights,
        "half the width of the region tried first [distances of the surface]", {0.2, 50});
  field("pixels", o.pixels, "number of pixels in one region whose depth is measured", {50, 100000});
  field("min_share", o.min_share, "minimum share of a region's pixels on the surface", {0, 1});
  field("mounting_sigma_deg", o.mounting_sigma_deg, "initial standard deviation of pitch and roll",
        {0.01, 45});
  field("mounting_sigma_distance", o.mounting_sigma_distance,
        "initial relative standard deviation of the height", {1e-3, 1});
  field("pitching_sigma_deg", o.pitching_sigma_deg,
        "random walk of pitch and roll from image to image", {0, 45});
  field("distance_drift", o.distance_drift,
        "relative random walk of the height from image to image", {0, 1});
  field("slope_sigma_deg", o.slope_sigma_deg,
        "random walk of pitch and roll after a plane that contradicts the filter", {0, 45});
}

void visit(OptionVisitor& field, PlaneNormalOptions& o) {
  field("views", o.views, "maximum number of views kept", {2, 1000});
  field("apart_px", o.apart_px, "minimum distance of a view from every kept one, for it to be kept",
        {0.01, 1000});
  field("sigma_px", o.sigma_px, "minimum standard deviation of a corner", {0.001, 100});
  field("max_sigma_deg", o.max_sigma_deg, "maximum standard deviation of the normal", {0.01, 90});
  field("distinct_deg", o.distinct_deg, "readings closer than this count as one", {0.1, 90});
}

void MotionFromPlanesOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, MotionFromPlanesOptions& o) {
  field("max_iterations", o.max_iterations, "maximum number of iterations of the joint refinement",
        {1, 10000});
  field.formerly("ambiguity_nats")(
      "ambiguity_log_ratio", o.ambiguity_log_ratio,
      "maximum difference in log-likelihood to the best reading that is kept", {0, 1e6});
}

void visit(OptionVisitor& field, TemplateFinderOptions& o) {
  field.group("features", o.features, "point features of the images");
  field("inlier_px", o.inlier_px, "maximum symmetric transfer error of an inlier [px]", {0.1, 50});
  field.internal().group("ransac", o.ransac, "homography hypotheses");
  field("places", o.places, "maximum number of proposals", {1, 100});
}

}  // namespace placegraph
