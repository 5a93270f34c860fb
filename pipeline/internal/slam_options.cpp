#include <placegraph/pipeline/slam_options.h>

namespace placegraph {

void visit(OptionVisitor& field, KeyframeViewOptions& o) {
  field("enabled", o.enabled, "keep how keyframes look");
  field.group("cues", o.cues, "cues that views are compared by");
}

void visit(OptionVisitor& field, SceneUseOptions& o) {
  field("enabled", o.enabled, "surfaces of keyframes say what is looked at");
  field.group("masks", o.masks, "what is kept out");
}

void visit(OptionVisitor& field, ContextOptions& o) {
  field("enabled", o.enabled, "kinds of environments are told, and places labelled by them");
  field("assume", o.assume, "motion is seen by what holds in the kind of environment");
  field.group("filter", o.filter, "the kind over views in order of travel");
}

void SlamOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, SlamOptions& o) {
  field("seed", o.seed, "of every random stream");
  field.group("odometry", o.odometry, "motion memory: relative poses and their window");
  field.group("loops", o.loops, "spatial memory: recognition of places");
  field.group("places", o.places, "topological places");
  field.group("pose_graph", o.pose_graph, "optimization of the place graph");
  field.group("views", o.views, "how keyframes look, for placegraph localize");
  field.group("semantics", o.semantics, "labels of surfaces, for motion and places");
  field.group("context", o.context, "the kind of environment and what is assumed there");
  field("max_lost_frames", o.max_lost_frames, "then a new component of the map begins",
        {1, 1000000});
}

}  // namespace placegraph
