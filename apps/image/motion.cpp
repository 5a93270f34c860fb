#include "apps/image/motion.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/text/json_text.h>

#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "apps/support/choice.h"
#include "apps/support/numbers_json.h"
#include "apps/support/output.h"
#include "apps/support/read_calib.h"
#include "apps/support/usage.h"

namespace placegraph::apps {
namespace {

using nlohmann::ordered_json;

/// Smallest number of distinct matches; repeated matches count once.
constexpr int kFewestDistinct = 8;
int distinct_matches(const MatchFile& file) {
  std::set<std::array<std::int64_t, 4>> seen;
  const auto rounded = [](double px) { return std::llround(px * 1000); };
  for (std::size_t i = 0; i < file.px_a.size(); ++i)
    seen.insert({rounded(file.px_a[i].x()), rounded(file.px_a[i].y()), rounded(file.px_b[i].x()),
                 rounded(file.px_b[i].y())});
  return static_cast<int>(seen.size());
}

/// Estimates the motion from matches of pixels if enough of them are distinct.
MotionEstimate motion_by_pixels(const MotionArguments& arguments, const Camera& camera,
                                Random& random) {
  const MatchFile file = read_matches(arguments.in);
  const int distinct = distinct_matches(file);
  MotionEstimate estimate;
  if (distinct < kFewestDistinct)
    estimate.outcome =
        Outcome::failure(Outcome::Code::kTooFewData,
                         fmt::format("{} distinct matches, {} needed", distinct, kFewestDistinct));
  else if (arguments.model == "gravity")
    estimate = motion_by_gravity(arguments.options, camera, file, random);
  else if (arguments.model == "circular")
    estimate = motion_by_circle(arguments.options, camera, file);
  else
    estimate = motion_by_two_views(arguments.model, arguments.options, camera, file, random);
  estimate.matches = static_cast<int>(file.px_a.size());
  return estimate;
}

MotionEstimate estimate_of(const MotionArguments& arguments, const std::optional<Camera>& camera,
                           Random& random) {
  if (arguments.model == "3d3d") {
    const PointPairFile file = read_point_pairs(arguments.in);
    MotionEstimate estimate = motion_by_clouds(arguments.options, file, random);
    estimate.matches = static_cast<int>(file.points_a.size());
    return estimate;
  }
  if (arguments.model == "3d2d") {
    const SeenPointFile file = read_seen_points(arguments.in);
    MotionEstimate estimate = motion_by_seen_points(arguments.options, *camera, file, random);
    estimate.matches = static_cast<int>(file.px.size());
    return estimate;
  }
  return motion_by_pixels(arguments, *camera, random);
}

void check(const MotionArguments& arguments) {
  const std::string& model = arguments.model;
  (void)choice<std::size_t>("--method", motion_model_names(), model);
  require(model == "3d3d" || !arguments.calib.empty(), "--calib is required for --method " + model);
  require(model != "gravity" || !arguments.options.gravity.empty(),
          "--gravity is required for --method gravity");
  require(arguments.options.gravity.empty() || model == "gravity" || model == "circular",
          "--gravity: --method " + model + " takes none");
}

}  // namespace

MotionResult motion(const MotionArguments& arguments) {
  check(arguments);
  if (!arguments.out.empty()) require_free(arguments.out, arguments.force);
  std::optional<Camera> camera;
  if (!arguments.calib.empty())
    camera = read_calib_without_distortion(arguments.calib, "a motion needs matches and");
  Random random(arguments.seed);
  const Stopwatch watch;
  MotionResult result{arguments.in, estimate_of(arguments, camera, random), 0, {}};
  result.cpu_ms = watch.cpu_ms();
  MotionEstimate& estimate = result.estimate;
  if (estimate.model.empty()) estimate.model = arguments.model;
  if (!estimate.outcome) result.no_result = arguments.in + ": " + estimate.outcome.reason;
  if (!arguments.out.empty()) write_file(arguments.out, to_json(result));
  return result;
}

std::string to_text(const MotionResult& result) {
  constexpr double kDeg = 180 / std::numbers::pi;
  const MotionEstimate& estimate = result.estimate;
  std::string text = fmt::format("{}: {}, {} of {} matches\n", result.in, estimate.model,
                                 estimate.inliers.size(), estimate.matches);
  if (estimate.R_ref_cur) {
    const Eigen::Matrix3d of_rotation = estimate.covariance.bottomRightCorner<3, 3>();
    const Eigen::Vector3d w = kDeg * estimate.R_ref_cur->log();
    const Eigen::Vector3d s = kDeg * of_rotation.diagonal().cwiseMax(0).cwiseSqrt();
    text +=
        fmt::format("  R_ref_cur: rotation vector {:.4f} {:.4f} {:.4f} deg", w.x(), w.y(), w.z());
    if (estimate.knows_covariance)
      text += fmt::format(", sigma {:.4f} {:.4f} {:.4f} deg", s.x(), s.y(), s.z());
    text += "\n";
  }
  if (estimate.T_ref_cur) {
    const Eigen::Vector3d& t = estimate.T_ref_cur->translation();
    const double sigma =
        std::sqrt(std::max(0.0, estimate.covariance.topLeftCorner<3, 3>().trace()));
    text += fmt::format("  t_ref_cur: {:.5f} {:.5f} {:.5f}{}", t.x(), t.y(), t.z(),
                        estimate.metric ? " m" : " (unknown length)");
    if (estimate.knows_covariance && estimate.metric)
      text += fmt::format(", sigma {:.5f} m", sigma);
    else if (estimate.knows_covariance)
      text += fmt::format(", sigma {:.3f} deg", kDeg * sigma);
    text += "\n";
  }
  if (estimate.R_ref_cur)
    for (const auto& [key, value] : estimate.evidence.items())
      text += fmt::format("  {} {:.4g}\n", key, value.get<double>());
  return text + fmt::format("  {:.1f} ms CPU\n", result.cpu_ms);
}

std::string to_json(const MotionResult& result) {
  const MotionEstimate& estimate = result.estimate;
  ordered_json json;
  json["in"] = result.in;
  json["matches"] = estimate.matches;
  json["model"] = estimate.model;
  json["outcome"] = to_string(estimate.outcome.code);
  if (!estimate.outcome) json["reason"] = estimate.outcome.reason;
  for (const char* key : {"T_ref_cur", "R_ref_cur", "t_ref_cur", "covariance"}) json[key] = nullptr;
  json["metric"] = estimate.metric;
  if (estimate.R_ref_cur) json["R_ref_cur"] = rows_json(estimate.R_ref_cur->matrix());
  if (estimate.T_ref_cur) {
    const Eigen::Vector3d& t = estimate.T_ref_cur->translation();
    json["T_ref_cur"] = rows_json(estimate.T_ref_cur->matrix());
    json["t_ref_cur"] = {t.x(), t.y(), t.z()};
  }
  if (estimate.knows_covariance && estimate.T_ref_cur)
    json["covariance"] = rows_json(estimate.covariance);
  else if (estimate.knows_covariance && estimate.R_ref_cur)
    json["covariance"] = rows_json(Eigen::Matrix3d(estimate.covariance.bottomRightCorner<3, 3>()));
  json["inliers"] = estimate.inliers.size();
  json["inlier_matches"] = estimate.inliers;
  for (const auto& [key, value] : estimate.evidence.items())
    json[key] = estimate.R_ref_cur ? value : ordered_json(nullptr);
  if (!estimate.rivals.empty()) {
    json["rivals"] = ordered_json::array();
    for (const SE3& rival : estimate.rivals) json["rivals"].push_back(rows_json(rival.matrix()));
  }
  json["cpu_ms"] = result.cpu_ms;
  return json_text(json, 2);
}

}  // namespace placegraph::apps
