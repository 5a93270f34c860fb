#include <placegraph/pipeline/slam_options.h>

namespace placegraph {

void visit(OptionVisitor& field, KeyframeViewOptions& o) {
  field.basic()("enabled", o.enabled,
                "store the appearance of keyframes, for `placegraph map localize`");
  field.internal().group("cues", o.cues, "descriptors of the stored appearance");
}

void visit(OptionVisitor& field, SceneUseOptions& o) {
  field.basic()("enabled", o.enabled, "label the surfaces of keyframes, for odometry and places");
  field.group("masks", o.masks, "labels whose pixels are excluded from tracking");
}

void visit(OptionVisitor& field, ContextOptions& o) {
  field.basic()("enabled", o.enabled,
                "classify the environment of keyframes and label places with it");
  field.basic()("assume", o.assume, "rely only on cues that usually hold in the environment");
  field.internal().group("filter", o.filter,
                         "smoothing of the environment class over consecutive keyframes");
}

void SlamOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, SlamOptions& o) {
  field.basic()("seed", o.seed, "seed of all random number generators");
  field.group("odometry", o.odometry, "visual odometry over a sliding window");
  field.group("loops", o.loops, "place recognition and loop closure");
  field.group("places", o.places, "topological places");
  field.group("pose_graph", o.pose_graph, "optimization of the place graph");
  field.group("views", o.views, "stored appearance of keyframes, for `placegraph map localize`");
  field.group("semantics", o.semantics, "surface labels for odometry and place recognition");
  field.group("context", o.context, "environment class and the assumptions that follow from it");
  field.group("overlays", o.overlays, "search for regions of the images that are fixed to the camera");
  field.basic()("max_lost_frames", o.max_lost_frames,
                "consecutive lost frames after which a new component of the map begins",
                {1, 1000000});
}

}  // namespace placegraph
