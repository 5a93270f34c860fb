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

void StaticOverlayOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, StaticOverlayOptions& o) {
  field.basic()("enabled", o.enabled,
                "find and mask what moves with the camera: dirt, time stamps, the bonnet");
  field.internal()("interval", o.interval,
                   "number of frames from one comparison of the patches to the next", {1, 100});
  field.internal()("standing_px", o.standing_px,
                   "maximum displacement of a patch that stands still [px]", {0.05, 5});
  field.internal()("min_motion_px", o.min_motion_px,
                   "displacement of most moving points that completes an episode [px]", {2, 100});
  field.internal()("min_contradiction_px", o.min_contradiction_px,
                   "minimum distance from a patch that stands still to where the motion allows it "
                   "[px]",
                   {0.1, 100});
  field.internal()("min_episodes", o.min_episodes,
                   "number of episodes that prove a patch to move with the camera", {1, 1000});
  field.internal()("min_patches", o.min_patches,
                   "minimum number of proven patches in a region that is masked", {1, 10000});
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
  field.group("overlays", o.overlays, "search for what moves with the camera");
  field.basic()("max_lost_frames", o.max_lost_frames,
                "consecutive lost frames after which a new component of the map begins",
                {1, 1000000});
}

}  // namespace placegraph
