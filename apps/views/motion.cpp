#include "apps/views/motion.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>

#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "apps/support/choice.h"
#include "apps/support/output.h"
#include "apps/support/read_calib.h"
#include "apps/support/rows_json.h"
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
  MotionEstimate answer;
  if (distinct < kFewestDistinct)
    answer.outcome =
        Outcome::failure(Outcome::Code::kTooFewData,
                         fmt::format("{} distinct matches, {} needed", distinct, kFewestDistinct));
  else if (arguments.model == "gravity")
    answer = motion_by_gravity(arguments.options, camera, file, random);
  else if (arguments.model == "circular")
    answer = motion_by_circle(arguments.options, camera, file);
  else
    answer = motion_by_two_views(arguments.model, arguments.options, camera, file, random);
  answer.matches = static_cast<int>(file.px_a.size());
  return answer;
}

MotionEstimate answer_of(const MotionArguments& arguments, const std::optional<Camera>& camera,
                         Random& random) {
  if (arguments.model == "3d3d") {
    const PointPairFile file = read_point_pairs(arguments.in);
    MotionEstimate answer = motion_by_clouds(arguments.options, file, random);
    answer.matches = static_cast<int>(file.points_a.size());
    return answer;
  }
  if (arguments.model == "3d2d") {
    const SeenPointFile file = read_seen_points(arguments.in);
    MotionEstimate answer = motion_by_seen_points(arguments.options, *camera, file, random);
    answer.matches = static_cast<int>(file.px.size());
    return answer;
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
  MotionResult result{arguments.in, answer_of(arguments, camera, random), 0, {}};
  result.cpu_ms = watch.cpu_ms();
  MotionEstimate& answer = result.answer;
  if (answer.model.empty()) answer.model = arguments.model;
  if (!answer.outcome) result.no_answer = arguments.in + ": " + answer.outcome.reason;
  if (!arguments.out.empty()) write_file(arguments.out, to_json(result));
  return result;
}

std::string to_text(const MotionResult& result) {
  constexpr double kDeg = 180 / std::numbers::pi;
  const MotionEstimate& answer = result.answer;
  std::string text = fmt::format("{}: {}, {} of {} matches\n", result.in, answer.model,
                                 answer.inliers.size(), answer.matches);
  if (answer.R_ref_cur) {
    const Eigen::Matrix3d of_rotation = answer.covariance.bottomRightCorner<3, 3>();
    const Eigen::Vector3d w = kDeg * answer.R_ref_cur->log();
    const Eigen::Vector3d s = kDeg * of_rotation.diagonal().cwiseMax(0).cwiseSqrt();
    text +=
        fmt::format("  R_ref_cur: rotation vector {:.4f} {:.4f} {:.4f} deg", w.x(), w.y(), w.z());
    if (answer.knows_covariance)
      text += fmt::format(", sigma {:.4f} {:.4f} {:.4f} deg", s.x(), s.y(), s.z());
    text += "\n";
  }
  if (answer.T_ref_cur) {
    const Eigen::Vector3d& t = answer.T_ref_cur->translation();
    const double sigma = std::sqrt(std::max(0.0, answer.covariance.topLeftCorner<3, 3>().trace()));
    text += fmt::format("  t_ref_cur: {:.5f} {:.5f} {:.5f}{}", t.x(), t.y(), t.z(),
                        answer.metric ? " m" : " (unknown length)");
    if (answer.knows_covariance && answer.metric)
      text += fmt::format(", sigma {:.5f} m", sigma);
    else if (answer.knows_covariance)
      text += fmt::format(", sigma {:.3f} deg", kDeg * sigma);
    text += "\n";
  }
  if (answer.R_ref_cur)
    for (const auto& [key, value] : answer.evidence.items())
      text += fmt::format("  {} {:.4g}\n", key, value.get<double>());
  return text + fmt::format("  {:.1f} ms CPU\n", result.cpu_ms);
}

std::string to_json(const MotionResult& result) {
  const MotionEstimate& answer = result.answer;
  ordered_json json;
  json["in"] = result.in;
  json["matches"] = answer.matches;
  json["model"] = answer.model;
  json["outcome"] = to_string(answer.outcome.code);
  if (!answer.outcome) json["reason"] = answer.outcome.reason;
  for (const char* key : {"T_ref_cur", "R_ref_cur", "t_ref_cur", "covariance"}) json[key] = nullptr;
  json["metric"] = answer.metric;
  if (answer.R_ref_cur) json["R_ref_cur"] = rows_json(answer.R_ref_cur->matrix());
  if (answer.T_ref_cur) {
    const Eigen::Vector3d& t = answer.T_ref_cur->translation();
    json["T_ref_cur"] = rows_json(answer.T_ref_cur->matrix());
    json["t_ref_cur"] = {t.x(), t.y(), t.z()};
  }
  if (answer.knows_covariance && answer.T_ref_cur)
    json["covariance"] = rows_json(answer.covariance);
  else if (answer.knows_covariance && answer.R_ref_cur)
    json["covariance"] = rows_json(Eigen::Matrix3d(answer.covariance.bottomRightCorner<3, 3>()));
  json["inliers"] = answer.inliers.size();
  json["inlier_matches"] = answer.inliers;
  for (const auto& [key, value] : answer.evidence.items())
    json[key] = answer.R_ref_cur ? value : ordered_json(nullptr);
  if (!answer.rivals.empty()) {
    json["rivals"] = ordered_json::array();
    for (const SE3& rival : answer.rivals) json["rivals"].push_back(rows_json(rival.matrix()));
  }
  json["cpu_ms"] = result.cpu_ms;
  return json.dump(2) + "\n";
}

}  // namespace placegraph::apps
