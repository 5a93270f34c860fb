#include <placegraph/backend/georeference/georeference_options.h>
#include <placegraph/graph/core/error.h>

namespace placegraph {

void GeoreferenceOptions::check() const {
  check_ranges(*this);
  require(kernel.width > 0, "kernel_width: must be positive");
}

void visit(OptionVisitor& field, GeoreferenceOptions& o) {
  field.choice("kernel", o.kernel.kind, robust_kernel_names(), "of the fixes, after Huber's");
  field("kernel_width", o.kernel.width, "in standard deviations of a fix", {1e-6, 1e6});
  field("min_accuracy_m", o.min_accuracy_m, "no receiver is taken for better", {1e-6, 1e6});
  field("estimate_accuracy", o.estimate_accuracy,
        "take fixes for worse than stated where they scatter more");
  field("estimate_odometry", o.estimate_odometry,
        "take relative poses for worse or better than stated where the fixes show it");
  field("estimate_delay", o.estimate_delay,
        "find by how much the map's poses lag behind their stamps, and undo it; not with "
        "estimate_clock_offset");
  field("max_gap_s", o.max_gap_s, "longer gaps of the motion are not bridged", {1e-3, 1e6});
  field("dropout_s", o.dropout_s, "a time without a fix that is longer is reported", {0, 1e6});
  field("estimate_lever_arm", o.estimate_lever_arm, "about the given one");
  field("lever_arm_sigma_m", o.lever_arm_sigma_m, "prior of the lever arm", {1e-6, 1e3});
  field("estimate_clock_offset", o.estimate_clock_offset, "about the given one");
  field("clock_offset_sigma_s", o.clock_offset_sigma_s,
        "prior of the clock offset and of the map's delay", {1e-6, 1e3});
  field.group("alignment", o.alignment, "first, rigid alignment");
  field.group("solver", o.solver, "optimization");
  field("seed", o.seed, "of the search for the alignment");
}

void GpsAlignmentOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, GpsAlignmentOptions& o) {
  field("max_bend_percent", o.max_bend_percent,
        "how far drift may have bent the map, in percent of the length of the way", {0, 100});
  field("max_angle_sigma_deg", o.max_angle_sigma_deg,
        "no answer if a rotation of the map is less certain than this", {1e-6, 180});
  field.internal().group("ransac", o.ransac, "search for fixes that agree");
}

}  // namespace placegraph
