#include <placegraph/pipeline/cues/surface_cue_options.h>

namespace placegraph {

void SurfaceCueOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, SurfaceCueOptions& o) {
  field.group("surface", o.surface, "the ground under a vehicle, by depths");
  field.group("planes", o.planes, "planes through the depths of the whole image");
  field.group("align", o.align, "motion by the grey values of surfaces");
  field("depths", o.depths, "asked for over the whole image, where planes are sought",
        {50, 1000000});
  field("max_planes", o.max_planes, "at once", {1, 50});
  field("min_plane_share", o.min_plane_share, "of the depths, for a plane", {0, 1});
  field("evenness_distance", o.evenness_distance,
        "no surface's distance is known better, as a share of it", {0, 1});
  field("evenness_deg", o.evenness_deg, "no surface's normal is known better", {0, 45});
  field("nodding_deg", o.nodding_deg, "of a vehicle about its mean pitch and roll, for one eye",
        {0, 45});
  field("sigma_height", o.sigma_height, "of the height of one eye, as a share of it", {1e-4, 1});
  field("keyframe_share", o.keyframe_share, "of the surfaces in view below which a keyframe is due",
        {0, 1});
  field("max_disagreement", o.max_disagreement,
        "of the motions there and back, in standard deviations", {0.1, 1000});
}

}  // namespace placegraph
