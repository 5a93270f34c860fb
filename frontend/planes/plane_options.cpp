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
  field("bound", o.bound, "maximum absolute value of a coordinate [sigma of the start]",
        {0.1, 100});
  field("seed", o.seed, "seed of the random streams");
  field("threads", o.threads, "number of threads; the result does not depend on it", {1, 256});
  field.retired({{"max_speed", 0.8}});
}

void DirectMotionOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, DirectMotionOptions& o) {
  field("levels", o.levels, "levels of the image pyramid, coarse to fine", {1, 8});
  field("samples", o.samples, "number of samples of all planes together, per level",
        {100, 1000000});
  field.group("swarm", o.swarm, "search without an initial motion");
  field.retired({{"min_samples", 150},
                 {"iterations", 12},
                 {"converged", 0.01},
                 {"min_visible_share", 0.3},
                 {"min_agreement", 0.5},
                 {"min_inlier_share", 0.4},
                 {"tile_px", 32},
                 {"kernel_width", 4.685}});
}

void visit(OptionVisitor& field, DepthPlanesOptions& o) {
  field("cell_px", o.cell_px, "side of the cells that planes are grown over", {4, 64});
  field("min_share", o.min_share, "minimum share of the image's cells on a plane", {0, 1});
  field("max_planes", o.max_planes, "maximum number of planes; the largest ones are kept",
        {1, 100});
  field("floor_deg", o.floor_deg,
        "minimum standard deviation of a normal, beyond the residuals' covariance", {1e-3, 10});
  field("floor_distance", o.floor_distance,
        "minimum relative standard deviation of the distance of a plane", {1e-5, 0.5});
  field.retired({{"step_px", 2}, {"max_sigma_deg", 1}, {"flatness", 0.002}});
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
  field.retired({{"step_px", 3},
                 {"pyramid_levels", 3},
                 {"iterations", 12},
                 {"pixel_correlation", 0.1},
                 {"min_zncc", 0.5},
                 {"min_samples", 400}});
}

void InverseDepthPlaneOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, InverseDepthPlaneOptions& o) {
  field.internal().group("ransac", o.ransac, "three-pixel hypotheses");
  field("max_sigma_deg", o.max_sigma_deg, "maximum standard deviation of the normal", {0.01, 45});
  field.retired({{"threshold_sigmas", 3}, {"max_sigma_distance", 0.1}});
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
  field.retired({{"pixels", 400},
                 {"mounting_sigma_deg", 5},
                 {"min_share", 0.4},
                 {"mounting_sigma_distance", 0.3},
                 {"pitching_sigma_deg", 0.3},
                 {"distance_drift", 0.005},
                 {"slope_sigma_deg", 2}});
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
