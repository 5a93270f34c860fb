#include <placegraph/pipeline/loops/loop_options.h>

namespace placegraph {

void LoopOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, LoopOptions& o) {
  field("enabled", o.enabled, "look for revisits");
  field.group("detector", o.detector, "features of a keyframe");
  field.group("database", o.database, "retrieval by visual words");
  field.group("verifier", o.verifier, "geometric verification");
  field("min_frame_gap", o.min_frame_gap, "nearer views are neighbours, not revisits", {1, 1e6});
  field("candidates", o.candidates, "retrieved views that are verified", {1, 100});
  field("min_similarity", o.min_similarity,
        "of a candidate, as a share of the similarity to the last keyframe", {0, 10});
  field("support_window", o.support_window, "keyframes within which a second loop must agree",
        {1, 1000});
  field("support_translation", o.support_translation,
        "disagreement of two loops over the median depth plus the way between them", {0.001, 10});
  field("support_angle_deg", o.support_angle_deg, "disagreement of two loops", {0.01, 180});
  field("drift_translation", o.drift_translation,
        "of the odometry over the median depth plus the way since the match", {0.001, 10});
  field("drift_angle_deg", o.drift_angle_deg, "of the odometry, per median depth of way",
        {0.001, 180});
  field("drift_scale", o.drift_scale, "of the unit of one eye (logarithm), per median depth of way",
        {0, 10});
  field("information_scale", o.information_scale,
        "share of a loop's information that counts: feature noise is correlated", {1e-6, 1});
}

}  // namespace placegraph
