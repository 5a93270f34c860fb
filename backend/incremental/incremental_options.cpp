#include <placegraph/backend/incremental/incremental_options.h>

namespace placegraph {

void IncrementalOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, IncrementalOptions& o) {
  field.choice("rotation_error", o.rotation_error, {"log", "quaternion"},
               "error of a relative pose: log of the group, or g2o's quaternion vector part");
  field("excess", o.excess,
        "maximum predicted excess of the cost over its minimum, as a share of the cost",
        {1e-12, 1});
  field("final_excess", o.final_excess, "the same for the last poses of a run", {1e-12, 1});
  field("relinearization", o.relinearization,
        "relative change of an edge's Jacobian at which it is linearized again", {0, 1});
  field("max_iterations", o.max_iterations,
        "maximum iterations of a step, before the graph is solved from scratch", {1, 1000});
}

}  // namespace placegraph
