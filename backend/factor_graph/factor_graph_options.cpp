#include <placegraph/backend/factor_graph/factor_graph_options.h>

namespace placegraph {

void FactorGraphOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, FactorGraphOptions& o) {
  field("max_iterations", o.max_iterations, "maximum number of steps of Levenberg-Marquardt",
        {1, 100000});
  field("relative_decrease", o.relative_decrease,
        "stop when the cost decreases by less than this share", {0, 1});
}

void BundleOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, BundleOptions& o) {
  field("max_iterations", o.max_iterations, "maximum number of steps of Levenberg-Marquardt",
        {1, 100000});
  field("relative_decrease", o.relative_decrease,
        "stop when the cost decreases by less than this share", {0, 1});
  field.choice("kernel", o.kernel.kind, robust_kernel_names(),
               "robust kernel on the reprojection errors");
  field("kernel_width_px", o.kernel.width, "width of the kernel [px]", {1e-3, 1e6});
}

}  // namespace placegraph
