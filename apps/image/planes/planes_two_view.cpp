#include "apps/image/planes/planes_two_view.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/text/json_text.h>
#include "apps/support/match_file.h"

#include <nlohmann/json.hpp>

#include "apps/support/numbers_json.h"
#include "apps/support/output.h"
#include "apps/support/read_calib.h"
#include "apps/support/usage.h"

namespace placegraph::apps {
namespace {

using nlohmann::ordered_json;

ordered_json regions_json(const PlanarRegionsResult& result) {
  ordered_json json = ordered_json::array();
  for (const PlanarRegion& region : result.regions)
    json.push_back({{"matches", region.matches},
                    {"H_b_a", numbers(region.H_cur_ref)},
                    {"covariance", numbers(region.covariance)}});
  return json;
}

ordered_json motion_json(const MotionFromPlanesResult& result) {
  ordered_json json;
  json["outcome"] = to_string(result.outcome.code);
  if (!result.outcome.reason.empty()) json["reason"] = result.outcome.reason;
  if (result.R_cur_ref) json["R_b_a"] = numbers(result.R_cur_ref->matrix());
  json["readings"] = ordered_json::array();
  for (const PlanesReading& reading : result.readings) {
    ordered_json one;
    one["R_b_a"] = numbers(reading.T_cur_ref.rotation().matrix());
    one["t_b_a"] = numbers(reading.T_cur_ref.translation());
    one["covariance"] = numbers(reading.covariance);
    one["cost_nats"] = reading.cost;
    one["planes"] = ordered_json::array();
    for (const Plane& plane : reading.planes_ref)
      one["planes"].push_back(
          {{"normal_a", numbers(plane.normal)}, {"distance", plane.distance_m}});
    json["readings"].push_back(one);
  }
  return json;
}

void check(const PlanesTwoViewArguments& arguments) {
  arguments.regions.check();
  arguments.planes_motion.check();
  require(arguments.motion.empty() || !arguments.calib.empty(), "--motion: needs --calib");
  require_free(arguments.out, arguments.force);
  if (!arguments.motion.empty()) require_free(arguments.motion, arguments.force);
}

void write_files(const PlanesTwoViewArguments& arguments, const PlanesTwoViewResult& result) {
  std::string text;
  for (const int label : result.planes.labels) text += std::to_string(label) + '\n';
  write_file(arguments.out, text);
  if (!arguments.motion.empty())
    write_file(arguments.motion, json_text(motion_json(*result.motion), 2));
}

}  // namespace

PlanesTwoViewResult planes_two_view(const PlanesTwoViewArguments& arguments) {
  check(arguments);
  const MatchFile file = read_matches(arguments.in);
  const PointMatches matches{file.px_a, file.px_b};
  std::optional<Camera> camera;
  if (!arguments.calib.empty())
    camera = read_calib_without_distortion(arguments.calib, "planes need matches and");

  PlanesTwoViewResult result{arguments.in, static_cast<int>(matches.size()), {}, {}, 0};
  const Stopwatch watch;
  Random random(arguments.seed);
  result.planes = find_planar_regions(matches, arguments.regions, random);
  if (camera && result.planes.outcome)
    result.motion = motion_from_planes(*camera, matches, result.planes, arguments.planes_motion);
  result.cpu_ms = watch.cpu_ms();

  // A result without planes is valid if there were enough matches: all labels are 0.
  if (result.planes.outcome.code == Outcome::Code::kTooFewData)
    throw NoResult(arguments.in + ": " + result.planes.outcome.reason);
  if (!arguments.motion.empty() && !result.motion) {
    result.motion.emplace();
    result.motion->outcome = Outcome::failure(Outcome::Code::kNoConsensus, "");
  }
  write_files(arguments, result);
  return result;
}

std::string to_text(const PlanesTwoViewResult& result) {
  const std::vector<PlanarRegion>& regions = result.planes.regions;
  int on_planes = 0;
  for (const PlanarRegion& region : regions) on_planes += region.matches;
  std::string text = fmt::format("{}: {} matches, {} planes, {} matches on none, noise {:.2f} px\n",
                                 result.in, result.matches, regions.size(),
                                 result.matches - on_planes, result.planes.noise.sigma_px);
  for (std::size_t k = 0; k < regions.size(); ++k)
    text += fmt::format("  plane {}: {} matches\n", k + 1, regions[k].matches);
  if (result.motion)
    text += fmt::format("  motion: {}, {} readings\n", to_string(result.motion->outcome.code),
                        result.motion->readings.size());
  return text + fmt::format("  {:.1f} ms CPU\n", result.cpu_ms);
}

std::string to_json(const PlanesTwoViewResult& result) {
  ordered_json json;
  json["in"] = result.in;
  json["matches"] = result.matches;
  json["noise_px"] = result.planes.noise.sigma_px;
  json["description_length_nats"] = result.planes.description_length;
  json["regions"] = regions_json(result.planes);
  if (result.motion) json["motion"] = motion_json(*result.motion);
  json["cpu_ms"] = result.cpu_ms;
  return json_text(json, 2);
}

}  // namespace placegraph::apps
