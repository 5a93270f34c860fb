#include <fmt/format.h>
#include <placegraph/eval/alignment/umeyama.h>
#include <placegraph/frontend/relative_pose/pose_3d2d.h>
#include <placegraph/frontend/relative_pose/relative_pose.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>

#include <Eigen/Dense>

#include "python/src/frontend/functions.h"
#include "python/src/values/value_class.h"

namespace placegraph::python {
namespace {

using namespace nb::literals;

/// Matched pixels of two views.
struct Matches {
  std::vector<Eigen::Vector2d> ref, cur;
};

Matches matches_of(const ArrayArgument<double>& px_ref, const ArrayArgument<double>& px_cur) {
  Matches matches{points_2d(px_ref, "px_ref"), points_2d(px_cur, "px_cur")};
  require_same_rows(matches.cur.size(), matches.ref.size(), "px_cur", "px_ref");
  return matches;
}

RelativePose relative_pose_of(const Camera& camera, const ArrayArgument<double>& px_ref,
                              const ArrayArgument<double>& px_cur,
                              const std::optional<std::string>& model,
                              const OptionsArgument<RelativePoseOptions>& options,
                              std::uint64_t seed) {
  const Matches matches = matches_of(px_ref, px_cur);
  RelativePoseOptions chosen = options.get();
  if (model)
    chosen.model = choice_of<RelativePoseModel>(*model, relative_pose_model_names(), "model");
  const WithoutGil released;
  Random random(seed);
  return estimate_relative_pose(camera, matches.ref, matches.cur, chosen, random);
}

Pose3d2dResult pose_of_points(const Camera& camera, const ArrayArgument<double>& points_ref,
                              const ArrayArgument<double>& px,
                              const OptionsArgument<Pose3d2dOptions>& options,
                              const std::optional<SE3>& prior, std::uint64_t seed) {
  const auto points = points_3d(points_ref, "points_ref");
  const auto pixels = points_2d(px, "px");
  require_same_rows(pixels.size(), points.size(), "px", "points_ref");
  const Pose3d2dOptions chosen = options.get();
  const WithoutGil released;
  Random random(seed);
  return estimate_pose_3d2d(camera, points, pixels, chosen, random, prior ? &*prior : nullptr);
}

/// Points with their covariances, N x 3 x 3, or one standard deviation for all.
std::vector<CloudPoint> cloud_of(const ArrayArgument<double>& points, const nb::object& covariance,
                                 const char* name, const char* covariance_name) {
  std::vector<CloudPoint> cloud;
  for (const Eigen::Vector3d& point : points_3d(points, name)) cloud.push_back({point});
  double sigma = 0;
  if (nb::try_cast<double>(covariance, sigma)) {
    require(std::isfinite(sigma) && sigma > 0,
            std::string(covariance_name) + ": a standard deviation above 0 is needed");
    for (CloudPoint& each : cloud) each.covariance = sigma * sigma * Eigen::Matrix3d::Identity();
    return cloud;
  }
  const auto rows = ArrayArgument<double>{covariance}.get(covariance_name, {kAny, 3, 3});
  require_same_rows(rows.shape(0), cloud.size(), covariance_name, name);
  using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    cloud[i].covariance = Eigen::Map<const RowMajor>(rows.data() + 9 * i);
    require(
        cloud[i].covariance.llt().info() == Eigen::Success,
        std::string(covariance_name) + ": row " + std::to_string(i) + " is not positive definite");
  }
  return cloud;
}

Pose3d3dResult pose_of_clouds(const ArrayArgument<double>& points_ref,
                              const ArrayArgument<double>& points_cur,
                              const nb::object& covariance_ref, const nb::object& covariance_cur,
                              const OptionsArgument<Pose3d3dOptions>& options, std::uint64_t seed) {
  const auto ref = cloud_of(points_ref, covariance_ref, "points_ref", "covariance_ref");
  const auto cur = cloud_of(points_cur, covariance_cur, "points_cur", "covariance_cur");
  require_same_rows(cur.size(), ref.size(), "points_cur", "points_ref");
  const Pose3d3dOptions chosen = options.get();
  const WithoutGil released;
  Random random(seed);
  return estimate_pose_3d3d(ref, cur, chosen, random);
}

GravityPoseResult pose_with_gravity(const Camera& camera, const ArrayArgument<double>& px_ref,
                                    const ArrayArgument<double>& px_cur,
                                    const ArrayArgument<double>& down_ref,
                                    const ArrayArgument<double>& down_cur,
                                    const OptionsArgument<GravityPoseOptions>& options,
                                    std::uint64_t seed) {
  const Matches matches = matches_of(px_ref, px_cur);
  const Eigen::Vector3d ref = direction_3(down_ref, "down_ref");
  const Eigen::Vector3d cur = direction_3(down_cur, "down_cur");
  const GravityPoseOptions chosen = options.get();
  const WithoutGil released;
  Random random(seed);
  return estimate_pose_with_gravity(camera, matches.ref, matches.cur, ref, cur, chosen, random);
}

CircularMotionResult circular_motion(const Camera& camera, const ArrayArgument<double>& px_ref,
                                     const ArrayArgument<double>& px_cur,
                                     const nb::object& R_level_cam,
                                     const OptionsArgument<CircularMotionOptions>& options) {
  const Matches matches = matches_of(px_ref, px_cur);
  SO3 level;
  if (!R_level_cam.is_none())
    level = SO3::from_matrix(matrix_3x3(ArrayArgument<double>{R_level_cam}, "R_level_cam"));
  const CircularMotionOptions chosen = options.get();
  const WithoutGil released;
  return estimate_circular_motion(camera, matches.ref, matches.cur, level, chosen);
}

AlignmentResult aligned_points(const ArrayArgument<double>& points_from,
                               const ArrayArgument<double>& points_to, bool with_scale) {
  const auto from = points_3d(points_from, "points_from"), to = points_3d(points_to, "points_to");
  require_same_rows(to.size(), from.size(), "points_to", "points_from");
  const WithoutGil released;
  return umeyama(from, to, with_scale);
}

std::optional<Eigen::Matrix3d> matrix_of(const std::optional<SO3>& R) {
  if (!R) return std::nullopt;
  return R->matrix();
}

/// The figures that results of several views share.
template <class Result>
nb::class_<Result> bind_views(nb::module_& m, const char* name, const char* docstring) {
  nb::class_<Result> result(m, name, docstring);
  bind_outcome(result);
  result.def_prop_ro(
      "inliers", [](const Result& r) { return view_of(r.inliers, r); },
      "Indices of the matches that agree with the result, ascending.");
  if constexpr (requires(Result r) { r.rmse_px; })
    result.def_ro("rmse_px", &Result::rmse_px, "Root mean square error of the inliers [px].");
  if constexpr (requires(Result r) { r.parallax_px; })
    result.def_ro("parallax_px", &Result::parallax_px, doc("RelativePose::parallax_px"));
  if constexpr (requires(Result r) { r.information; })
    result.def_ro("information", &Result::information,
                  "Information of the pose's right tangent [translation, rotation], 6 x 6.");
  return result;
}

void bind_results(nb::module_& m) {
  bind_views<RelativePose>(m, "RelativePose", doc("RelativePose"))
      .def_prop_ro(
          "model",
          [](const RelativePose& r) {
            return relative_pose_model_names().at(static_cast<std::size_t>(r.model));
          },
          doc("RelativePose::model"))
      .def_ro("T_ref_cur", &RelativePose::T_ref_cur,
              "The motion, which maps points of cur to ref; its translation has length 1. None if "
              "`model` is 'rotation'.")
      .def_prop_ro(
          "R_ref_cur", [](const RelativePose& r) { return matrix_of(r.R_ref_cur); },
          "The rotation, 3 x 3; None if nothing is known of it.")
      .def_ro(
          "covariance", &RelativePose::covariance,
          "Covariance of the right tangent of T_ref_cur, [translation, rotation], zero along the "
          "translation; if `model` is 'rotation', only the block of the rotation is set.")
      .def_ro("homography_share", &RelativePose::homography_share,
              "Share of the homography's score of those of both models.")
      .def_prop_ro("rivals", as_tuple(&RelativePose::rivals), doc("RelativePose::rivals"));
  bind_views<Pose3d2dResult>(m, "Pose3d2dResult", doc("Pose3d2dResult"))
      .def_ro("T_ref_cam", &Pose3d2dResult::T_ref_cam, doc("Pose3d2dResult::T_ref_cam"));
  bind_views<Pose3d3dResult>(m, "Pose3d3dResult", doc("Pose3d3dResult"))
      .def_ro("T_ref_cur", &Pose3d3dResult::T_ref_cur, "Maps points of cur to ref.")
      .def_ro("chi2_per_dof", &Pose3d3dResult::chi2_per_dof, doc("Pose3d3dResult::chi2_per_dof"));
  bind_views<GravityPoseResult>(m, "GravityPoseResult", doc("GravityPoseResult"))
      .def_ro("T_ref_cur", &GravityPoseResult::T_ref_cur, doc("GravityPoseResult::T_ref_cur"));
  bind_views<CircularMotionResult>(m, "CircularMotionResult", doc("CircularMotionResult"))
      .def_ro("T_ref_cur", &CircularMotionResult::T_ref_cur, doc("CircularMotionResult::T_ref_cur"))
      .def_ro("yaw_rad", &CircularMotionResult::yaw_rad, doc("CircularMotionResult::yaw_rad"))
      .def_ro("sigma_yaw_rad", &CircularMotionResult::sigma_yaw_rad,
              doc("CircularMotionResult::sigma_yaw_rad"));
  nb::class_<AlignmentResult> alignment(m, "AlignmentResult", doc("AlignmentResult"));
  bind_outcome(alignment);
  bind_value(alignment, Hash::kByValue);
  alignment.def_ro("scale", &AlignmentResult::scale, doc("AlignmentResult::scale"))
      .def_ro("R_truth_estimate", &AlignmentResult::R_truth_estimate, "The rotation, 3 x 3.")
      .def_ro("t_truth_estimate", &AlignmentResult::t_truth_estimate, "The translation [m].")
      .def_ro("rmse_m", &AlignmentResult::rmse_m, doc("AlignmentResult::rmse_m"))
      .def_ro("pairs", &AlignmentResult::pairs, doc("AlignmentResult::pairs"))
      .def_ro("rank", &AlignmentResult::rank, doc("AlignmentResult::rank"))
      .def("__repr__", [](const AlignmentResult& a) {
        return fmt::format("<placegraph.AlignmentResult: scale {:.6g}, rmse {:.6g} m of {} pairs>",
                           a.scale, a.rmse_m, a.pairs);
      });
}

void bind_options_of_motion(nb::module_& m) {
  bind_option_set<RelativePoseOptions>(m, "RelativePoseOptionSet", doc("RelativePoseOptions"));
  bind_option_set<Pose3d2dOptions>(m, "Pose3d2dOptionSet", doc("Pose3d2dOptions"));
  bind_option_set<Pose3d3dOptions>(m, "Pose3d3dOptionSet", doc("Pose3d3dOptions"));
  bind_option_set<GravityPoseOptions>(m, "GravityPoseOptionSet", doc("GravityPoseOptions"));
  bind_option_set<CircularMotionOptions>(m, "CircularMotionOptionSet",
                                         doc("CircularMotionOptions"));
}

}  // namespace

void bind_motion(nb::module_& m) {
  bind_options_of_motion(m);
  bind_results(m);
  m.def("estimate_relative_pose", &relative_pose_of, "camera"_a, "px_ref"_a, "px_cur"_a,
        "model"_a = nb::none(), "options"_a = nb::none(), "seed"_a = 1,
        doc("estimate_relative_pose"));
  m.def("estimate_pose_3d2d", &pose_of_points, "camera"_a, "points_ref"_a, "px"_a,
        "options"_a = nb::none(), "prior"_a = nb::none(), "seed"_a = 1, doc("estimate_pose_3d2d"));
  m.def("estimate_pose_3d3d", &pose_of_clouds, "points_ref"_a, "points_cur"_a,
        "covariance_ref"_a = 0.01, "covariance_cur"_a = 0.01, "options"_a = nb::none(),
        "seed"_a = 1, doc("estimate_pose_3d3d"));
  m.def("estimate_pose_with_gravity", &pose_with_gravity, "camera"_a, "px_ref"_a, "px_cur"_a,
        "down_ref"_a, "down_cur"_a, "options"_a = nb::none(), "seed"_a = 1,
        doc("estimate_pose_with_gravity"));
  m.def("estimate_circular_motion", &circular_motion, "camera"_a, "px_ref"_a, "px_cur"_a,
        "R_level_cam"_a = nb::none(), "options"_a = nb::none(), doc("estimate_circular_motion"));
  m.def("umeyama", &aligned_points, "points_from"_a, "points_to"_a, "with_scale"_a = false,
        doc("umeyama"));
}

}  // namespace placegraph::python
