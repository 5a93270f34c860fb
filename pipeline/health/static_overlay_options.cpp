#include <placegraph/pipeline/health/static_overlay_options.h>

namespace placegraph {

void StaticOverlayOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, StaticOverlayOptions& o) {
  field.basic()("enabled", o.enabled,
                "find and mask regions fixed to the camera: dirt, time stamps, the bonnet");
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

}  // namespace placegraph
