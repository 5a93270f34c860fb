#include <placegraph/pipeline/loops/loop_options.h>

namespace placegraph {

void LoopOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, LoopOptions& o) {
  field.basic()("enabled", o.enabled, "detect loop closures");
  field.group("detector", o.detector, "features of a keyframe");
  field.internal().group("database", o.database, "retrieval by visual words");
  field.internal().group("verifier", o.verifier, "geometric verification");
  field.basic()("min_frame_gap", o.min_frame_gap,
                "minimum number of frames between two keyframes of a loop", {1, 1e6});
  field.basic()("candidates", o.candidates,
                "maximum number of keyframes retrieved and verified per query", {1, 100});
  field.basic()("min_similarity", o.min_similarity,
                "minimum similarity of a candidate, as a share of that of the previous keyframe",
                {0, 10});
  field("drift_translation", o.drift_translation,
        "assumed odometry drift over (median depth + path length)", {0.001, 10});
  field("drift_angle_deg", o.drift_angle_deg,
        "assumed rotation drift per median depth of path length [deg]", {0.001, 180});
  field("drift_scale", o.drift_scale,
        "assumed monocular scale drift (logarithm) per median depth of path length", {0, 10});
  field.retired({{"support_window", 4},
                 {"support_translation", 0.03},
                 {"support_angle_deg", 2},
                 {"information_scale", 0.1}});
}

}  // namespace placegraph
