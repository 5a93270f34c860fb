#include <placegraph/frontend/cloud_planes/cloud_planes_options.h>

namespace placegraph {

void CloudPlanesOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, CloudPlanesOptions& o) {
  field.choice("method", o.method, {"cuts", "ransac", "growing"}, "method that finds planes");
  field("flatness", o.flatness, "maximum deviation from a plane, as a share of the depth",
        {1e-6, 0.1});
  field("inlier_sigmas", o.inlier_sigmas,
        "maximum distance of a plane's points, in standard deviations", {0.5, 10});
  field("min_points", o.min_points, "minimum number of points of a plane", {3, 1e9});
  field("max_cut", o.max_cut, "maximum value of a normalized cut that is made", {0, 2});
  field("min_probability", o.min_probability, "minimum probability that a segment is a plane",
        {0, 1});
  field("seed", o.seed, "seed of the random samples");
}

}  // namespace placegraph
