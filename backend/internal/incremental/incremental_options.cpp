#include <placegraph/backend/incremental/incremental_options.h>

namespace placegraph {

void IncrementalOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, IncrementalOptions& o) {
  field.choice("rotation_error", o.rotation_error, {"log", "quaternion"},
               "error of a relative pose: log of the group, or g2o's quaternion vector part");
  field("excess", o.excess,
        "iterate until the cost is predicted to lie above its minimum by no more than this share",
        {1e-12, 1});
  field("final_excess", o.final_excess, "the same at the end", {1e-12, 1});
  field("relinearization", o.relinearization,
        "linearize an edge anew when its Jacobian has changed by this share", {0, 1});
  field("max_iterations", o.max_iterations,
        "of a step, before the whole graph is solved from scratch", {1, 1000});
}

}  // namespace placegraph
