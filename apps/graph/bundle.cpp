#include "apps/graph/bundle.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/text/json_text.h>
#include <placegraph/io/graphs/bal.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/support/choice.h"
#include "apps/support/output.h"
#include "apps/support/usage.h"

namespace placegraph::apps {
namespace {

/// Number of cameras or points, of `all`, that no observation names.
std::size_t unobserved(const Bundle& bundle, std::size_t all, int BundleObservation::*named) {
  std::vector<bool> observed(all);
  for (const BundleObservation& observation : bundle.observations)
    observed[static_cast<std::size_t>(observation.*named)] = true;
  return static_cast<std::size_t>(std::ranges::count(observed, false));
}

}  // namespace

BundleResult bundle(const BundleArguments& arguments) {
  BundleOptions options = arguments.options;
  options.kernel.kind =
      choice<RobustKernel::Kind>("--kernel", robust_kernel_names(), arguments.kernel);
  options.check();
  if (!arguments.out.empty()) require_free(arguments.out, arguments.force);
  const Bundle start = read_bal(arguments.in);

  BundleResult result{
      .in = arguments.in,
      .out = arguments.out,
      .cameras = start.cameras.size(),
      .points = start.points.size(),
      .observations = start.observations.size(),
      .unused_cameras = unobserved(start, start.cameras.size(), &BundleObservation::camera),
      .unused_points = unobserved(start, start.points.size(), &BundleObservation::point),
      .report = {}};
  const Stopwatch stopwatch;
  result.report = adjust_bundle(start, options);
  result.cpu_ms = stopwatch.cpu_ms();
  result.wall_ms = stopwatch.wall_ms();
  if (!result.report.outcome) throw NoResult(arguments.in + ": " + result.report.outcome.reason);
  if (!arguments.out.empty()) write_bal(arguments.out, result.report.bundle);
  return result;
}

std::string to_json(const BundleResult& result) {
  nlohmann::ordered_json json;
  json["in"] = result.in;
  json["cameras"] = result.cameras;
  json["points"] = result.points;
  json["observations"] = result.observations;
  json["unused_cameras"] = result.unused_cameras;
  json["unused_points"] = result.unused_points;
  json["cost_initial"] = result.report.cost_initial;
  json["cost"] = result.report.cost_final;
  json["rms_px"] = result.report.rms_px;
  json["iterations"] = result.report.iterations;
  json["cpu_ms"] = result.cpu_ms;
  json["wall_ms"] = result.wall_ms;
  return json_text(json, 2);
}

std::string to_text(const BundleResult& result) {
  const BundleReport& report = result.report;
  const std::string unused =
      result.unused_cameras + result.unused_points == 0
          ? ""
          : fmt::format("  kept as they are, without observations: {} cameras, {} points\n",
                        result.unused_cameras, result.unused_points);
  return fmt::format("{}: {} cameras, {} points, {} observations\n", result.in, result.cameras,
                     result.points, result.observations) +
         unused +
         fmt::format("  half the sum of squares {:.6f} -> {:.6f}, {:.4f} px rms\n",
                     report.cost_initial, report.cost_final, report.rms_px) +
         fmt::format("  {} iterations, {:.1f} ms CPU, {:.1f} ms wall{}\n", report.iterations,
                     result.cpu_ms, result.wall_ms,
                     result.out.empty() ? "" : "; written to " + result.out);
}

}  // namespace placegraph::apps
