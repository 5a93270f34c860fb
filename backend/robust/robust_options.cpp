#include <placegraph/backend/robust/robust_options.h>

namespace placegraph {

void GncOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, GncOptions& o) {
  field.choice("surrogate", o.surrogate, {"truncated", "geman_mcclure"},
               "robust cost that the rounds approximate");
  field("least_factor", o.least_factor, "minimum factor by which a round lowers the threshold",
        {1.01, 100});
  field("share_per_round", o.share_per_round,
        "share of the undecided edges that a round may reject", {0, 1});
  field("max_rounds", o.max_rounds, "maximum number of rounds of reweighting", {1, 10000});
}

void LoopSupportOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, LoopSupportOptions& o) {
  field("reach", o.reach, "maximum number of poses between the ends of two compared loops",
        {1, 100000});
  field("neighbours", o.neighbours, "number of nearest loops that each loop is compared with",
        {1, 1000});
  field("least_probability", o.least_probability,
        "minimum probability that two loops which support each other are both true",
        {0.01, 0.9999});
}

void LoopSetGrowthOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, LoopSetGrowthOptions& o) {
  field("margin", o.margin,
        "factor of the gate over the chi-squared quantile, for noise with longer tails",
        {0.1, 1000});
  field("tail", o.tail,
        "largest error of another true loop, as a multiple of the largest accepted error",
        {1, 100});
  field("nearly_right", o.nearly_right,
        "largest error of an inaccurate true loop [share of map extent and of 180 deg]", {0, 1});
  field("max_rounds", o.max_rounds, "maximum number of rounds in which every loop is tested",
        {1, 1000});
}

void RobustOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, RobustOptions& o) {
  field.choice("method", o.method, {"none", "huber", "dcs", "gnc", "pcm", "auto"},
               "robust method against false loops; none: the kernels of the constraints");
  field("kernel_width", o.kernel_width,
        "width of the kernel of huber and dcs [standard deviations]", {1e-9, 1e9});
  field("gate_probability", o.gate_probability,
        "share of true loops with a squared error below the gate under Gaussian noise",
        {0.5, 0.999999});
  field.group("gnc", o.gnc, "graduated non-convexity");
  field.group("support", o.support, "selection of loops that agree with loops nearby");
  field.group("growth", o.growth,
              "loop set growth: acceptance of loops, starting with the best supported");
}

}  // namespace placegraph
