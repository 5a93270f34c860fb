#include "apps/views/cmd_motion.h"

#include <fmt/format.h>
#include <placegraph/frontend/relative_pose/circular_motion.h>
#include <placegraph/frontend/relative_pose/pose_3d2d.h>
#include <placegraph/frontend/relative_pose/pose_3d3d.h>
#include <placegraph/frontend/relative_pose/pose_gravity.h>
#include <placegraph/frontend/relative_pose/relative_pose.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/measurements/match_file.h>

#include <CLI/CLI.hpp>
#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "apps/support/calib_option.h"
#include "apps/support/read_calib.h"
#include "apps/support/output.h"
#include "apps/support/usage.h"

namespace placegraph::apps {
namespace {

using nlohmann::ordered_json;

const std::vector<std::string>& models() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all = relative_pose_model_names();
    for (const char* other : {"gravity", "circular", "3d2d", "3d3d"}) all.emplace_back(other);
    return all;
  }();
  return names;
}

struct MotionArguments {
  std::string in, calib, out, model = "auto", gravity;
  bool json = false, force = false;
  std::uint64_t seed = 1;
  std::optional<double> threshold_px;
  std::optional<int> min_inliers;
  double noise_m = 0.01;
};

/// What every model answers.
struct Answer {
  Outcome outcome;
  std::string model;
  int matches = 0;
  std::optional<SE3> T_ref_cur;
  std::optional<SO3> R_ref_cur;
  bool metric = false;
  Matrix6d covariance = Matrix6d::Zero();
  bool knows_covariance = true;
  std::vector<int> inliers;
  std::vector<SE3> rivals;
  ordered_json evidence = ordered_json::object();  ///< figures of the model's own
};

/// Of the degrees of freedom that are told at all.
Matrix6d covariance_of(const Matrix6d& information) {
  return information.completeOrthogonalDecomposition().pseudoInverse();
}

struct Verticals {
  Eigen::Vector3d ref, cur;  ///< of unit length, downwards
};

/// A match told often tells no more than once.
constexpr int kFewestDistinct = 8;
int distinct_matches(const MatchFile& file) {
  std::set<std::array<std::int64_t, 4>> seen;
  const auto rounded = [](double px) { return std::llround(px * 1000); };
  for (std::size_t i = 0; i < file.px_a.size(); ++i)
    seen.insert({rounded(file.px_a[i].x()), rounded(file.px_a[i].y()), rounded(file.px_b[i].x()),
                 rounded(file.px_b[i].y())});
  return static_cast<int>(seen.size());
}

/// "x,y,z", the same in both cameras, or "x,y,z,x,y,z".
Verticals verticals_of(const std::string& text) {
  const std::string wanted =
      "--gravity: x,y,z or x,y,z,x,y,z expected: downwards in the first camera and in the second";
  std::vector<std::string_view> fields;
  split_comma(text, fields);
  require(fields.size() == 3 || fields.size() == 6, wanted);
  Eigen::VectorXd v(6);
  for (int i = 0; i < 6; ++i) {
    const auto number = parse_double(fields[static_cast<std::size_t>(i) % fields.size()]);
    require(number.has_value(), wanted);
    v[i] = *number;
  }
  require(v.head<3>().norm() > 1e-9 && v.tail<3>().norm() > 1e-9,
          "--gravity: a direction needs a length");
  return {v.head<3>().normalized(), v.tail<3>().normalized()};
}

template <class Options>
void adopt(const MotionArguments& arguments, Options& options) {
  if (arguments.threshold_px) options.threshold_px = *arguments.threshold_px;
  if (arguments.min_inliers) options.ransac.min_inliers = *arguments.min_inliers;
}

Answer by_two_views(const MotionArguments& arguments, const Camera& camera, const MatchFile& file,
                    Random& random) {
  RelativePoseOptions options;
  const auto& names = relative_pose_model_names();
  options.model = static_cast<RelativePoseModel>(
      std::find(names.begin(), names.end(), arguments.model) - names.begin());
  adopt(arguments, options.two_view);
  adopt(arguments, options.rotation);
  const RelativePose found = estimate_relative_pose(camera, file.px_a, file.px_b, options, random);
  Answer answer;
  answer.outcome = found.outcome;
  answer.model = names[static_cast<std::size_t>(found.model)];
  answer.T_ref_cur = found.T_ref_cur;
  answer.R_ref_cur = found.R_ref_cur;
  answer.covariance = found.covariance;
  answer.inliers = found.inliers;
  answer.rivals = found.rivals;
  answer.evidence = {{"rmse_px", found.rmse_px},
                     {"parallax_px", found.parallax_px},
                     {"homography_share", found.homography_share}};
  return answer;
}

Answer by_gravity(const MotionArguments& arguments, const Camera& camera, const MatchFile& file,
                  Random& random) {
  const Verticals down = verticals_of(arguments.gravity);
  GravityPoseOptions options;
  adopt(arguments, options);
  const GravityPoseResult found =
      estimate_pose_with_gravity(camera, file.px_a, file.px_b, down.ref, down.cur, options, random);
  Answer answer;
  answer.outcome = found.outcome;
  if (found.outcome) answer.T_ref_cur = found.T_ref_cur;
  if (found.outcome || found.outcome.code == Outcome::Code::kDegenerate)
    answer.R_ref_cur = found.T_ref_cur.rotation();
  answer.covariance = covariance_of(found.information);
  answer.inliers = found.inliers;
  answer.evidence = {{"rmse_px", found.rmse_px}, {"parallax_px", found.parallax_px}};
  return answer;
}

Answer by_circle(const MotionArguments& arguments, const Camera& camera, const MatchFile& file) {
  CircularMotionOptions options;
  if (arguments.threshold_px) options.threshold_px = *arguments.threshold_px;
  if (arguments.min_inliers) options.min_inliers = *arguments.min_inliers;
  SO3 R_level_cam;
  if (!arguments.gravity.empty())
    R_level_cam =
        SO3::from_matrix(Eigen::Quaterniond::FromTwoVectors(verticals_of(arguments.gravity).ref,
                                                            Eigen::Vector3d::UnitY())
                             .toRotationMatrix());
  const CircularMotionResult found =
      estimate_circular_motion(camera, file.px_a, file.px_b, R_level_cam, options);
  Answer answer;
  answer.outcome = found.outcome;
  if (found.outcome) {
    answer.T_ref_cur = found.T_ref_cur;
    answer.R_ref_cur = found.T_ref_cur.rotation();
  }
  // As if the model were exact: a deviation of the yaw is not one of the pose.
  answer.knows_covariance = false;
  answer.inliers = found.inliers;
  answer.evidence = {{"yaw_rad", found.yaw_rad},
                     {"sigma_yaw_rad", found.sigma_yaw_rad},
                     {"rmse_px", found.rmse_px},
                     {"parallax_px", found.parallax_px}};
  return answer;
}

Answer by_seen_points(const MotionArguments& arguments, const Camera& camera,
                      const SeenPointFile& file, Random& random) {
  Pose3d2dOptions options;
  adopt(arguments, options);
  const Pose3d2dResult found = estimate_pose_3d2d(camera, file.points, file.px, options, random);
  Answer answer;
  answer.outcome = found.outcome;
  if (found.outcome) {
    answer.T_ref_cur = found.T_ref_cam;
    answer.R_ref_cur = found.T_ref_cam.rotation();
    answer.covariance = found.information.ldlt().solve(Matrix6d::Identity());
  }
  answer.metric = true;
  answer.inliers = found.inliers;
  answer.evidence = {{"rmse_px", found.rmse_px}};
  return answer;
}

Answer by_clouds(const MotionArguments& arguments, const PointPairFile& file, Random& random) {
  require(arguments.noise_m > 0, "--noise: must be positive");
  require(!arguments.threshold_px, "--threshold: is of pixels, and 3d3d has none");
  Pose3d3dOptions options;
  if (arguments.min_inliers) options.ransac.min_inliers = *arguments.min_inliers;
  const Eigen::Matrix3d covariance =
      arguments.noise_m * arguments.noise_m * Eigen::Matrix3d::Identity();
  const auto cloud = [&](const std::vector<Eigen::Vector3d>& points) {
    std::vector<CloudPoint> result;
    for (const Eigen::Vector3d& point : points) result.push_back({point, covariance});
    return result;
  };
  const Pose3d3dResult found =
      estimate_pose_3d3d(cloud(file.points_a), cloud(file.points_b), options, random);
  Answer answer;
  answer.outcome = found.outcome;
  if (found.outcome) {
    answer.T_ref_cur = found.T_ref_cur;
    answer.R_ref_cur = found.T_ref_cur.rotation();
    answer.covariance = found.information.ldlt().solve(Matrix6d::Identity());
  }
  answer.metric = true;
  answer.inliers = found.inliers;
  answer.evidence = {{"chi2_per_dof", found.chi2_per_dof}};
  return answer;
}

template <class Matrix>
ordered_json rows_json(const Matrix& matrix) {
  ordered_json rows = ordered_json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    ordered_json row = ordered_json::array();
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) row.push_back(matrix(i, j));
    rows.push_back(row);
  }
  return rows;
}

ordered_json answer_json(const MotionArguments& arguments, const Answer& answer, double cpu_ms) {
  ordered_json json;
  json["in"] = arguments.in;
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
  json["cpu_ms"] = cpu_ms;
  return json;
}

void print(const MotionArguments& arguments, const Answer& answer, double cpu_ms) {
  constexpr double kDeg = 180 / std::numbers::pi;
  fmt::print("{}: {}, {} of {} matches\n", arguments.in, answer.model, answer.inliers.size(),
             answer.matches);
  const Eigen::Matrix3d of_rotation = answer.covariance.bottomRightCorner<3, 3>();
  if (answer.R_ref_cur) {
    const Eigen::Vector3d w = kDeg * answer.R_ref_cur->log();
    const Eigen::Vector3d s = kDeg * of_rotation.diagonal().cwiseMax(0).cwiseSqrt();
    fmt::print("  R_ref_cur: turned by {:.4f} {:.4f} {:.4f} deg", w.x(), w.y(), w.z());
    if (answer.knows_covariance)
      fmt::print(", known to {:.4f} {:.4f} {:.4f} deg", s.x(), s.y(), s.z());
    fmt::print("\n");
  }
  if (answer.T_ref_cur) {
    const Eigen::Vector3d& t = answer.T_ref_cur->translation();
    const double sigma = std::sqrt(std::max(0.0, answer.covariance.topLeftCorner<3, 3>().trace()));
    fmt::print("  t_ref_cur: {:.5f} {:.5f} {:.5f}{}", t.x(), t.y(), t.z(),
               answer.metric ? " m" : " (its length is not seen)");
    if (answer.knows_covariance && answer.metric)
      fmt::print(", known to {:.5f} m", sigma);
    else if (answer.knows_covariance)
      fmt::print(", known to {:.3f} deg", kDeg * sigma);
    fmt::print("\n");
  }
  if (answer.R_ref_cur)
    for (const auto& [key, value] : answer.evidence.items())
      fmt::print("  {} {:.4g}\n", key, value.get<double>());
  fmt::print("  {:.1f} ms CPU\n", cpu_ms);
}

void run(const MotionArguments& arguments) {
  const std::string& model = arguments.model;
  require(model == "3d3d" || !arguments.calib.empty(), "--calib is required for --model " + model);
  require(model != "gravity" || !arguments.gravity.empty(),
          "--gravity is required for --model gravity");
  require(arguments.gravity.empty() || model == "gravity" || model == "circular",
          "--gravity: --model " + model + " takes none");
  if (!arguments.out.empty()) require_free(arguments.out, arguments.force);
  std::optional<Camera> camera;
  if (!arguments.calib.empty())
    camera = read_calib_without_distortion(arguments.calib, "a motion needs matches and");
  Random random(arguments.seed);
  const Stopwatch watch;
  Answer answer;
  const auto of_pixels = [&](const auto& estimate) {
    const MatchFile file = read_matches(arguments.in);
    const int distinct = distinct_matches(file);
    if (distinct < kFewestDistinct)
      answer.outcome = Outcome::failure(
          Outcome::Code::kTooFewData,
          fmt::format("{} distinct matches, {} needed", distinct, kFewestDistinct));
    else
      answer = estimate(file);
    answer.matches = static_cast<int>(file.px_a.size());
  };
  if (model == "3d3d") {
    const PointPairFile file = read_point_pairs(arguments.in);
    answer = by_clouds(arguments, file, random);
    answer.matches = static_cast<int>(file.points_a.size());
  } else if (model == "3d2d") {
    const SeenPointFile file = read_seen_points(arguments.in);
    answer = by_seen_points(arguments, *camera, file, random);
    answer.matches = static_cast<int>(file.px.size());
  } else if (model == "gravity") {
    of_pixels([&](const MatchFile& f) { return by_gravity(arguments, *camera, f, random); });
  } else if (model == "circular") {
    of_pixels([&](const MatchFile& f) { return by_circle(arguments, *camera, f); });
  } else {
    of_pixels([&](const MatchFile& f) { return by_two_views(arguments, *camera, f, random); });
  }
  if (answer.model.empty()) answer.model = model;
  const double cpu_ms = watch.cpu_ms();
  const ordered_json json = answer_json(arguments, answer, cpu_ms);
  if (!arguments.out.empty()) write_file(arguments.out, json.dump(2) + "\n");
  if (arguments.json) std::puts(json.dump(2).c_str());
  // Its evidence is told all the same, to those who read JSON.
  if (!answer.outcome) throw NoAnswer(arguments.in + ": " + answer.outcome.reason);
  if (!arguments.json) print(arguments, answer, cpu_ms);
}

}  // namespace

void add_motion_command(CLI::App& app) {
  auto arguments = std::make_shared<MotionArguments>();
  MotionArguments& a = *arguments;
  CLI::App* command =
      app.add_subcommand("motion", "How a camera moved between two views of matched points");
  command->footer("placegraph motion matches.txt --calib K.txt --json");
  command
      ->add_option("MATCHES", a.in,
                   "lines of xA yA xB yB [px]; of X Y Z x y for 3d2d, of xA yA zA xB yB zB for "
                   "3d3d [m]; further columns are not read")
      ->required()
      ->check(CLI::ExistingFile);
  add_calib_option(*command, a.calib, std::string("camera of both views: ") + kCalibFile);
  command
      ->add_option("--model", a.model,
                   "what explains the views: auto chooses among essential, homography and "
                   "rotation; gravity: three points and both verticals; circular: a car; 3d2d, "
                   "3d3d: points of known place in one view or both")
      ->check(CLI::IsMember(models()))
      ->capture_default_str();
  command->add_option("--gravity", a.gravity,
                      "x,y,z[,x,y,z]: downwards in the first camera [and in the second]; needed by "
                      "gravity; levels the camera of a car");
  command->add_option("--threshold", a.threshold_px, "inliers lie within this [px]");
  command->add_option("--min-inliers", a.min_inliers, "fewer allow no answer");
  command->add_option("--noise", a.noise_m, "of each coordinate, for 3d3d [m]")
      ->capture_default_str();
  command->add_option("--seed", a.seed, "of the random samples")->capture_default_str();
  command->add_option("-o,--out", a.out, "JSON file");
  command->add_flag("--json", a.json, "print JSON");
  command->add_flag("--force", a.force, "overwrite OUT");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace placegraph::apps
