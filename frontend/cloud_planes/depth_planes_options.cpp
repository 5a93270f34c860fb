#include <placegraph/frontend/cloud_planes/depth_planes_options.h>

namespace placegraph {

void visit(OptionVisitor& field, DepthPlanesOptions& o) {
  field("cell_px", o.cell_px, "side of the cells that planes are grown over", {4, 64});
  field("step_px", o.step_px, "between the pixels that are looked at", {1, 16});
  field("flatness", o.flatness, "what a plane may bend, as a share of the depth", {0, 0.1});
  field("min_share", o.min_share, "of the image, for a plane", {0, 1});
  field("max_planes", o.max_planes, "of an image, the largest", {1, 100});
  field("max_sigma_deg", o.max_sigma_deg, "of the normal, to be of use", {0.01, 30});
  field("floor_deg", o.floor_deg, "what normals may be off by beyond what their residuals tell",
        {1e-3, 10});
  field("floor_distance", o.floor_distance, "the same of distances, as a share", {1e-5, 0.5});
}

}  // namespace placegraph
