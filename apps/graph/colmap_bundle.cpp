#include "apps/graph/colmap_bundle.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/text/json_text.h>
#include <placegraph/pipeline/exports/colmap_adjustment.h>

#include <nlohmann/json.hpp>

#include "apps/support/choice.h"
#include "apps/support/output.h"
#include "apps/support/usage.h"

namespace placegraph::apps {

ColmapBundleResult colmap_bundle(const BundleArguments& arguments) {
  BundleOptions options = arguments.options;
  options.kernel.kind =
      choice<RobustKernel::Kind>("--kernel", robust_kernel_names(), arguments.kernel);
  options.check();
  if (!arguments.out.empty()) require_free_folder(arguments.out, arguments.force);
  ColmapAdjustment adjustment(arguments.in);
  const Stopwatch stopwatch;
  const ColmapAdjustmentReport report = adjustment.adjust(options);
  if (!report.outcome) throw NoResult(arguments.in + ": " + report.outcome.reason);
  if (!arguments.out.empty()) adjustment.write(arguments.out);
  return {.in = arguments.in,
          .out = arguments.out,
          .images = adjustment.images(),
          .points = adjustment.points(),
          .observations = report.observations,
          .cost_initial = report.cost_initial,
          .cost = report.cost_final,
          .error_before_px = report.error_before_px,
          .error_px = report.error_px,
          .iterations = report.iterations,
          .unused_cameras = adjustment.unused_cameras(),
          .cpu_ms = stopwatch.cpu_ms(),
          .wall_ms = stopwatch.wall_ms()};
}

std::string to_json(const ColmapBundleResult& result) {
  nlohmann::ordered_json json;
  json["in"] = result.in;
  json["images"] = result.images;
  json["points"] = result.points;
  json["observations"] = result.observations;
  json["cost_initial"] = result.cost_initial;
  json["cost"] = result.cost;
  json["error_before_px"] = result.error_before_px;
  json["error_px"] = result.error_px;
  json["iterations"] = result.iterations;
  json["unused_cameras"] = result.unused_cameras;
  json["cpu_ms"] = result.cpu_ms;
  json["wall_ms"] = result.wall_ms;
  return json_text(json, 2);
}

std::string to_text(const ColmapBundleResult& result) {
  const std::string unused =
      result.unused_cameras.empty()
          ? ""
          : "  kept as they are: " + describe_unused_cameras(result.unused_cameras) + "\n";
  return fmt::format("{}: {} images, {} points, {} observations\n", result.in, result.images,
                     result.points, result.observations) +
         unused +
         fmt::format(
             "  half the sum of squares {:.6f} -> {:.6f}, mean reprojection error {:.4f} -> "
             "{:.4f} px\n",
             result.cost_initial, result.cost, result.error_before_px, result.error_px) +
         fmt::format("  {} iterations, {:.1f} ms CPU, {:.1f} ms wall{}\n", result.iterations,
                     result.cpu_ms, result.wall_ms,
                     result.out.empty() ? "" : "; written to " + result.out);
}

}  // namespace placegraph::apps
