#include <placegraph/backend/pose_graph/pose_graph_options.h>

namespace placegraph {

void GncOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, GncOptions& o) {
  field.choice("surrogate", o.surrogate, {"truncated", "geman_mcclure"},
               "the robust cost that is approached");
  field("least_factor", o.least_factor, "by which a round lowers the threshold at least",
        {1.01, 100});
  field("share_per_round", o.share_per_round,
        "of the undecided edges that a round may leave behind", {0, 1});
  field("max_rounds", o.max_rounds, "of reweighting", {1, 10000});
}

void LoopSupportOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, LoopSupportOptions& o) {
  field("reach", o.reach, "poses between the ends of two loops that are held against each other",
        {1, 100000});
  field("neighbours", o.neighbours, "loops that one loop is held against, the nearest ones",
        {1, 1000});
  field("least_probability", o.least_probability,
        "that two loops are both true, for them to support each other", {0.01, 0.9999});
}

void LoopSetGrowthOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, LoopSetGrowthOptions& o) {
  field("margin", o.margin,
        "of the gate over the chi-squared quantile: real noise has longer tails", {0.1, 1000});
  field("tail", o.tail, "times the largest error of true loops that another one may have",
        {1, 100});
  field("nearly_right", o.nearly_right,
        "share of the map's extent (and of half a turn) by which a true loop may be badly measured",
        {0, 1});
  field("max_rounds", o.max_rounds, "of testing every loop", {1, 1000});
}

void RobustOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, RobustOptions& o) {
  field.choice("method", o.method, {"none", "huber", "dcs", "gnc", "pcm", "auto"},
               "what is done against false loops; none: the kernels the constraints carry");
  field("kernel_width", o.kernel_width, "of huber and dcs, in standard deviations", {1e-9, 1e9});
  field("gate_probability", o.gate_probability,
        "share of the true loops whose squared error lies below the gate, were noise Gaussian",
        {0.5, 0.999999});
  field.group("gnc", o.gnc, "graduated non-convexity");
  field.group("support", o.support, "which loops agree with loops nearby");
  field.group("growth", o.growth, "which loops are true, from the best supported ones on");
}

void PoseGraphOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, PoseGraphOptions& o) {
  field.choice("rotation_error", o.rotation_error, {"log", "quaternion"},
               "error of a relative pose: log of the group, or g2o's quaternion vector part");
  field.choice("engine", o.engine, {"native", "ceres"}, "which solver finds the minimum");
  field.choice("step_rule", o.step_rule, {"dogleg", "gauss_newton", "levenberg_marquardt"},
               "how the native engine steps");
  field.formerly("start").choice("initialization", o.start, {"auto", "file", "odometry", "chordal", "certified"},
               "where the descent begins; auto: the cheapest start whose minimum can be trusted");
  field("max_iterations", o.max_iterations, "steps of the descent at most", {1, 100000});
  field("relative_decrease", o.relative_decrease,
        "stop when the cost falls by less than this share", {0, 1});
  field.group("robust", o.robust, "what is done against false loops");
}

}  // namespace placegraph
