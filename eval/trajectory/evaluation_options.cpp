#include <placegraph/eval/trajectory/evaluation_options.h>

namespace placegraph {

void EvaluationOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, EvaluationOptions& o) {
  field.choice("align", o.alignment, {"none", "origin", "se3", "sim3", "scale", "yaw"},
               "transformation fitted before the comparison");
  field.group("align_over", o.align_over, "poses that the transformation is fitted to");
  field.choice("vertical", o.vertical, {"estimated", "x", "y", "z"},
               "vertical of the ground truth's world");
  field.choice("part", o.part, {"space", "xy", "xz", "yz", "fitted", "x", "y", "z"},
               "part of the position errors that is judged");
  field.choice("associate", o.association, {"auto", "index", "time"},
               "association of the poses of the two files");
  field("max_difference_s", o.time.max_difference_s,
        "largest difference of the stamps of a pair [s]", {0, 1e6});
  field("offset_s", o.time.offset_s, "offset added to the estimate's stamps [s]", {-1e12, 1e12});
  field.group("segments", o.segments, "segments of t_rel and r_rel");
  const std::string before = to_string(o.below);
  std::string below = before;
  field("below", below, "bounds of errors, as 0.1m,1deg: shares of the drive below them; empty: none");
  if (below != before) o.below = parse_error_bounds(below);
  field("intervals", o.intervals, "confidence intervals of the figures");
  field.group("relative", o.relative, "relative errors over other steps than one frame");
}

}  // namespace placegraph
