#include "apps/views/cmd_planes.h"

#include <fmt/format.h>
#include <placegraph/frontend/planes/motion_from_planes.h>
#include <placegraph/frontend/planes/planar_regions.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/measurements/match_file.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/support/calib_option.h"
#include "apps/support/read_calib.h"
#include "apps/support/json_file.h"
#include "apps/support/output.h"
#include "apps/support/usage.h"
#include "apps/views/cmd_planes_cloud.h"

namespace placegraph::apps {
namespace {

using nlohmann::ordered_json;

struct PlanesArguments {
  std::string in, out, calibration, motion;
  bool json = false, force = false;
  std::uint64_t seed = 1;
  PlanarRegionsOptions regions;
  MotionFromPlanesOptions planes_motion;
};

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
  if (!result.outcome) json["reason"] = result.outcome.reason;
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

void print(const PlanesArguments& arguments, int matches, const PlanarRegionsResult& result,
           const ordered_json& motion, double cpu_ms) {
  if (arguments.json) {
    ordered_json json;
    json["in"] = arguments.in;
    json["matches"] = matches;
    json["noise_px"] = result.noise.sigma_px;
    json["description_length_nats"] = result.description_length;
    json["regions"] = regions_json(result);
    if (!motion.is_null()) json["motion"] = motion;
    json["cpu_ms"] = cpu_ms;
    std::puts(json.dump(2).c_str());
    return;
  }
  int on_planes = 0;
  for (const PlanarRegion& region : result.regions) on_planes += region.matches;
  fmt::print("{}: {} matches, {} planes, {} matches on none, noise {:.2f} px\n", arguments.in,
             matches, result.regions.size(), matches - on_planes, result.noise.sigma_px);
  for (std::size_t k = 0; k < result.regions.size(); ++k)
    fmt::print("  plane {}: {} matches\n", k + 1, result.regions[k].matches);
  if (!motion.is_null())
    fmt::print("  motion: {}, {} readings\n", motion["outcome"].get<std::string>(),
               motion["readings"].size());
  fmt::print("  {:.1f} ms CPU\n", cpu_ms);
}

void run(const PlanesArguments& arguments) {
  arguments.regions.check();
  arguments.planes_motion.check();
  require(arguments.motion.empty() || !arguments.calibration.empty(), "--motion: needs --calib");
  require(arguments.motion.empty() || arguments.motion != arguments.out,
          "--motion: the same file as --out");
  require_free(arguments.out, arguments.force);
  if (!arguments.motion.empty()) require_free(arguments.motion, arguments.force);
  const MatchFile file = read_matches(arguments.in);
  const PointMatches matches{file.px_a, file.px_b};
  std::optional<Camera> camera;
  if (!arguments.calibration.empty())
    camera = read_calib_without_distortion(arguments.calibration, "planes need matches and");

  const Stopwatch watch;
  Random random(arguments.seed);
  const PlanarRegionsResult result = find_planar_regions(matches, arguments.regions, random);
  ordered_json motion;
  if (camera && result.outcome)
    motion = motion_json(motion_from_planes(*camera, matches, result, arguments.planes_motion));
  const double cpu_ms = watch.cpu_ms();

  // No plane is an answer, too, where there were matches enough: all labels are 0.
  if (result.outcome.code == Outcome::Code::kTooFewData)
    throw NoAnswer(arguments.in + ": " + result.outcome.reason);
  std::string text;
  for (const int label : result.labels) text += std::to_string(label) + '\n';
  write_file(arguments.out, text);
  if (!arguments.motion.empty()) {
    if (motion.is_null())
      motion = {{"outcome", "no consensus"}, {"readings", ordered_json::array()}};
    write_file(arguments.motion, motion.dump(2) + '\n');
  }
  print(arguments, matches.size(), result, motion, cpu_ms);
}

}  // namespace

void add_planes_command(CLI::App& app) {
  CLI::App* planes =
      app.add_subcommand("planes", "Planes in a point cloud, or behind the matches of two views");
  planes->footer("placegraph planes depth.png --calib K.txt --depth-scale 0.001 --out planes.png");
  planes->require_subcommand(0, 1);
  add_cloud_planes(*planes);
  auto arguments = std::make_shared<PlanesArguments>();
  PlanesArguments& a = *arguments;
  CLI::App* command = planes->add_subcommand(
      "two-view", "Label the point matches of two views by the plane they lie on");
  command->footer(
      "placegraph planes two-view matches.txt --out labels.txt --calib K.txt "
      "--motion motion.json");
  command->add_option("MATCHES", a.in, "lines of xA yA xB yB [px]; further columns are not read")
      ->required()
      ->check(CLI::ExistingFile);
  command->add_option("-o,--out", a.out, "one label a match: 0 on no plane, 1 the largest plane")
      ->required();
  add_calib_option(*command, a.calibration,
                   std::string("camera of both views: also the motion; ") + kCalibFile,
                   "--calibration");
  command->add_option("--motion", a.motion, "motion and planes as JSON");
  command->add_option("--noise", a.regions.noise_px, "of a match, about [px]")
      ->capture_default_str();
  command->add_option("--min-matches", a.regions.min_matches, "a plane with fewer is none")
      ->capture_default_str();
  command->add_option("--seed", a.seed, "of the random samples")->capture_default_str();
  command->add_flag("--json", a.json, "print JSON");
  command->add_flag("--force", a.force, "overwrite outputs");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace placegraph::apps
