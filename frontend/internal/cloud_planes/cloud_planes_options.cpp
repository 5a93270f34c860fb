#include <placegraph/frontend/internal/cloud_planes/cloud_planes_options.h>

namespace placegraph {

void CloudPlanesOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, CloudPlanesOptions& o) {
  field.choice("method", o.method, {"cuts", "ransac", "growing"}, "how planes are found");
  field("flatness", o.flatness, "what a plane may bend, as a share of the depth", {1e-6, 0.1});
  field("inlier_sigmas", o.inlier_sigmas, "points of a plane are this near", {0.5, 10});
  field("min_points", o.min_points, "fewer are no plane", {3, 1e9});
  field("max_cut", o.max_cut, "normalized cuts above it are not made", {0, 2});
  field("min_probability", o.min_probability, "of a segment being a plane, to be one", {0, 1});
  field("seed", o.seed, "of the random samples");
}

}  // namespace placegraph
