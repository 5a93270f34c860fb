#include <placegraph/backend/window/sliding_window_options.h>
#include <placegraph/graph/core/error.h>

namespace placegraph {

void SlidingWindowOptions::check() const {
  check_ranges(*this);
  require(scale_drift >= 0 && scale_drift <= 1, "scale_drift: must lie between 0 and 1");
}

void visit(OptionVisitor& field, SlidingWindowOptions& o) {
  field.basic()("max_keyframes", o.max_keyframes,
                "maximum number of keyframes; above it the oldest is marginalized", {2, 1000});
  field("max_iterations", o.max_iterations, "maximum number of steps of Levenberg-Marquardt",
        {1, 1000});
  field("huber_px", o.huber_px, "width of the Huber kernel [standard deviations of a pixel]",
        {1e-3, 1e6});
  field("relative_decrease", o.relative_decrease,
        "stop when the cost decreases by less than this share", {0, 1});
}

}  // namespace placegraph
