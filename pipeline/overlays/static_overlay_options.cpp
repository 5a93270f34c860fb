#include <placegraph/pipeline/overlays/static_overlay_options.h>

namespace placegraph {

void StaticOverlayOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, StaticOverlayOptions& o) {
  field.basic()("enabled", o.enabled,
                "find and mask regions fixed to the camera: dirt, time stamps, the bonnet");
  field.retired({{"interval", 2},
                 {"min_motion_px", 8},
                 {"min_contradiction_px", 0.5},
                 {"min_episodes", 2},
                 {"min_patches", 6},
                 {"standing_px", 0.3}});
}

}  // namespace placegraph
