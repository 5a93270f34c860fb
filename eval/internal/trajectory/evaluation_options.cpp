#include <placegraph/eval/trajectory/evaluation_options.h>
#include <placegraph/graph/core/error.h>

namespace placegraph {

void SegmentOptions::check() const {
  check_ranges(*this);
  require(!lengths_m.empty(), "lengths_m: empty list");
}

void visit(OptionVisitor& field, SegmentOptions& o) {
  field("lengths_m", o.lengths_m, "segment lengths of t_rel and r_rel [m]", {1e-3, 1e6});
  field("step", o.step, "frames between segment starts", {1, 1e6});
  field("frame_rate_hz", o.frame_rate_hz, "for speeds where the ground truth has no times",
        {1e-3, 1e4});
  field("speed_bin_m_per_s", o.speed_bin_m_per_s, "width of a row of the table per speed",
        {1e-3, 1e3});
}

void EvaluationOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, EvaluationOptions& o) {
  field.choice("align", o.alignment, {"none", "origin", "se3", "sim3", "scale"},
               "what is fitted before comparing");
  field.choice("associate", o.association, {"auto", "index", "time"},
               "how lines of the two files are paired");
  field("max_difference_s", o.time.max_difference_s, "largest difference of stamps of a pair",
        {0, 1e6});
  field("offset_s", o.time.offset_s, "added to the estimate's stamps", {-1e12, 1e12});
  field.group("segments", o.segments, "t_rel and r_rel");
}

}  // namespace placegraph
