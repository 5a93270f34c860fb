#include <placegraph/pipeline/scale/floor_line_scale_options.h>

namespace placegraph {

void FloorScaleOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, FloorScaleOptions& o) {
  field.group("floor", o.floor, "which lines lie on the floor");
  field("sigma_relative", o.sigma_relative, "of a single height, beyond that of its lines", {0, 1});
  field("max_log_jump", o.max_log_jump,
        "a scale further from the median of the last ones (in logarithm) is not believed",
        {0.01, 5});
  field("max_sigma_at_first", o.max_sigma_at_first, "of the height that gives the unit, relative",
        {0.001, 1});
}

}  // namespace placegraph
