#include <placegraph/backend/pose_graph/pose_graph_options.h>

namespace placegraph {

void PoseGraphOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, PoseGraphOptions& o) {
  field.choice("rotation_error", o.rotation_error, {"log", "quaternion"},
               "error of a relative pose: log of the group, or g2o's quaternion vector part");
  field.choice("engine", o.engine, {"native", "ceres"}, "solver of the optimization");
  field.choice("step_rule", o.step_rule, {"dogleg", "gauss_newton", "levenberg_marquardt"},
               "step rule of the native engine");
  field.formerly("start").choice(
      "initialization", o.initialization, {"auto", "file", "odometry", "chordal", "certified"},
      "initial poses; auto: the cheapest initialization whose minimum can be trusted");
  field("max_iterations", o.max_iterations, "maximum number of steps of one descent", {1, 100000});
  field("relative_decrease", o.relative_decrease,
        "stop when the cost decreases by less than this share", {0, 1});
  field.group("robust", o.robust, "robust optimization against false loops");
}

}  // namespace placegraph
