#include <fmt/format.h>
#include <placegraph/pipeline/exports/export_summary.h>

namespace placegraph {

std::string to_text(const ColmapSummary& summary) {
  return fmt::format(
      "COLMAP: {} keyframes, {} points, {} of {} observations kept ({:.1f} %), mean reprojection "
      "error {:.2f} px ({:.2f} px before the adjustment), {:.1f} views a point{}\n",
      summary.keyframes, summary.points, summary.kept, summary.observations,
      100.0 * static_cast<double>(summary.kept) / static_cast<double>(summary.observations),
      summary.error_px, summary.error_before_px, summary.views,
      summary.lens_k1 == 0
          ? ""
          : fmt::format("; the named images are distorted by k1 = {:.4f}", summary.lens_k1));
}

std::string to_text(const DenseSummary& summary) {
  std::string text =
      fmt::format("dense: {} keyframes by {}, voxels of {:.3g} {}", summary.keyframes,
                  summary.source, summary.voxel, summary.metric ? "m" : "units of the map");
  if (summary.points) text += fmt::format(", {} points", *summary.points);
  if (summary.vertices)
    text += fmt::format(", {} vertices and {} triangles", *summary.vertices, *summary.triangles);
  return text + fmt::format(", {:.1f} s CPU\n", summary.cpu_s);
}

}  // namespace placegraph
