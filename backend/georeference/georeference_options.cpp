#include <placegraph/backend/georeference/georeference_options.h>
#include <placegraph/graph/core/error.h>

namespace placegraph {

void GeoreferenceOptions::check() const {
  check_ranges(*this);
  require(kernel.width > 0, "kernel_width: must be positive");
}

void visit(OptionVisitor& field, GeoreferenceOptions& o) {
  field.choice("kernel", o.kernel.kind, robust_kernel_names(),
               "robust kernel of the fixes, applied after Huber's");
  field("kernel_width", o.kernel.width, "width of the kernel [standard deviations of a fix]",
        {1e-6, 1e6});
  field("min_accuracy_m", o.min_accuracy_m, "smallest standard deviation assumed for a fix [m]",
        {1e-6, 1e6});
  field("estimate_accuracy", o.estimate_accuracy,
        "increase the stated standard deviations of fixes that scatter more");
  field("estimate_odometry", o.estimate_odometry,
        "scale the stated covariances of relative poses that the fixes contradict");
  field("estimate_delay", o.estimate_delay,
        "estimate and correct a latency of the map's poses; not with estimate_clock_offset");
  field("max_gap_s", o.max_gap_s, "longest gap of the motion that is interpolated [s]",
        {1e-3, 1e6});
  field("dropout_s", o.dropout_s, "longer gaps between fixes are reported [s]", {0, 1e6});
  field("estimate_lever_arm", o.estimate_lever_arm,
        "estimate the lever arm, with the given one as prior");
  field("lever_arm_sigma_m", o.lever_arm_sigma_m,
        "standard deviation of the prior of the lever arm [m]", {1e-6, 1e3});
  field("estimate_clock_offset", o.estimate_clock_offset,
        "estimate the clock offset, with the given one as prior");
  field("clock_offset_sigma_s", o.clock_offset_sigma_s,
        "standard deviation of the prior of clock offset and map latency [s]", {1e-6, 1e3});
  field.group("alignment", o.alignment, "initial rigid alignment");
  field.group("solver", o.solver, "optimization");
  field("seed", o.seed, "seed of the random search for the alignment");
}

void GpsAlignmentOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, GpsAlignmentOptions& o) {
  field("max_bend_percent", o.max_bend_percent,
        "maximum deformation of the map by drift [percent of the path length]", {0, 100});
  field("max_angle_sigma_deg", o.max_angle_sigma_deg,
        "maximum standard deviation of the map's rotation [deg]; fails above it", {1e-6, 180});
  field.internal().group("ransac", o.ransac, "search for consistent fixes");
}

}  // namespace placegraph
