#include "apps/image/motion_models.h"

#include <placegraph/frontend/relative_pose/pose_3d2d.h>
#include <placegraph/frontend/relative_pose/relative_pose.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/text_file.h>

#include <Eigen/Dense>

#include "apps/support/choice.h"

namespace placegraph::apps {
namespace {

/// Covariance of the observable degrees of freedom.
Matrix6d covariance_of(const Matrix6d& information) {
  return information.completeOrthogonalDecomposition().pseudoInverse();
}

struct Verticals {
  Eigen::Vector3d ref, cur;  ///< unit vectors, downwards
};

/// Parses "x,y,z", the same for both cameras, or "x,y,z,x,y,z".
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
void adopt(const MotionModelOptions& asked, Options& options) {
  if (asked.threshold_px) options.threshold_px = *asked.threshold_px;
  if (asked.min_inliers) options.ransac.min_inliers = *asked.min_inliers;
}

}  // namespace

const std::vector<std::string>& motion_model_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all = relative_pose_model_names();
    for (const char* other : {"gravity", "circular", "3d2d", "3d3d"}) all.emplace_back(other);
    return all;
  }();
  return names;
}

MotionEstimate motion_by_two_views(const std::string& name, const MotionModelOptions& asked,
                                   const Camera& camera, const MatchFile& file, Random& random) {
  RelativePoseOptions options;
  const auto& names = relative_pose_model_names();
  options.model = choice<RelativePoseModel>("--method", names, name);
  adopt(asked, options.two_view);
  adopt(asked, options.rotation);
  const RelativePose found = estimate_relative_pose(camera, file.px_a, file.px_b, options, random);
  MotionEstimate estimate;
  estimate.outcome = found.outcome;
  estimate.model = names[static_cast<std::size_t>(found.model)];
  estimate.T_ref_cur = found.T_ref_cur;
  estimate.R_ref_cur = found.R_ref_cur;
  estimate.covariance = found.covariance;
  estimate.inliers = found.inliers;
  estimate.rivals = found.rivals;
  estimate.evidence = {{"rmse_px", found.rmse_px},
                       {"parallax_px", found.parallax_px},
                       {"homography_share", found.homography_share}};
  return estimate;
}

MotionEstimate motion_by_gravity(const MotionModelOptions& asked, const Camera& camera,
                                 const MatchFile& file, Random& random) {
  const Verticals down = verticals_of(asked.gravity);
  GravityPoseOptions options;
  adopt(asked, options);
  const GravityPoseResult found =
      estimate_pose_with_gravity(camera, file.px_a, file.px_b, down.ref, down.cur, options, random);
  MotionEstimate estimate;
  estimate.outcome = found.outcome;
  if (found.outcome) estimate.T_ref_cur = found.T_ref_cur;
  if (found.outcome || found.outcome.code == Outcome::Code::kDegenerate)
    estimate.R_ref_cur = found.T_ref_cur.rotation();
  estimate.covariance = covariance_of(found.information);
  estimate.inliers = found.inliers;
  estimate.evidence = {{"rmse_px", found.rmse_px}, {"parallax_px", found.parallax_px}};
  return estimate;
}

MotionEstimate motion_by_circle(const MotionModelOptions& asked, const Camera& camera,
                                const MatchFile& file) {
  CircularMotionOptions options;
  if (asked.threshold_px) options.threshold_px = *asked.threshold_px;
  if (asked.min_inliers) options.min_inliers = *asked.min_inliers;
  SO3 R_level_cam;
  if (!asked.gravity.empty())
    R_level_cam = SO3::from_matrix(Eigen::Quaterniond::FromTwoVectors(
                                       verticals_of(asked.gravity).ref, Eigen::Vector3d::UnitY())
                                       .toRotationMatrix());
  const CircularMotionResult found =
      estimate_circular_motion(camera, file.px_a, file.px_b, R_level_cam, options);
  MotionEstimate estimate;
  estimate.outcome = found.outcome;
  if (found.outcome) {
    estimate.T_ref_cur = found.T_ref_cur;
    estimate.R_ref_cur = found.T_ref_cur.rotation();
  }
  // The deviation of the yaw assumes an exact circular motion; it is no covariance of the pose.
  estimate.knows_covariance = false;
  estimate.inliers = found.inliers;
  estimate.evidence = {{"yaw_rad", found.yaw_rad},
                       {"sigma_yaw_rad", found.sigma_yaw_rad},
                       {"rmse_px", found.rmse_px},
                       {"parallax_px", found.parallax_px}};
  return estimate;
}

MotionEstimate motion_by_seen_points(const MotionModelOptions& asked, const Camera& camera,
                                     const SeenPointFile& file, Random& random) {
  Pose3d2dOptions options;
  adopt(asked, options);
  const Pose3d2dResult found = estimate_pose_3d2d(camera, file.points, file.px, options, random);
  MotionEstimate estimate;
  estimate.outcome = found.outcome;
  if (found.outcome) {
    estimate.T_ref_cur = found.T_ref_cam;
    estimate.R_ref_cur = found.T_ref_cam.rotation();
    estimate.covariance = found.information.ldlt().solve(Matrix6d::Identity());
  }
  estimate.metric = true;
  estimate.inliers = found.inliers;
  estimate.evidence = {{"rmse_px", found.rmse_px}};
  return estimate;
}

MotionEstimate motion_by_clouds(const MotionModelOptions& asked, const PointPairFile& file,
                                Random& random) {
  require(asked.noise_m > 0, "--point-noise: must be positive");
  require(!asked.threshold_px, "--threshold: is in pixels and does not apply to 3d3d");
  Pose3d3dOptions options;
  if (asked.min_inliers) options.ransac.min_inliers = *asked.min_inliers;
  const Eigen::Matrix3d covariance = asked.noise_m * asked.noise_m * Eigen::Matrix3d::Identity();
  const auto cloud = [&](const std::vector<Eigen::Vector3d>& points) {
    std::vector<CloudPoint> result;
    for (const Eigen::Vector3d& point : points) result.push_back({point, covariance});
    return result;
  };
  const Pose3d3dResult found =
      estimate_pose_3d3d(cloud(file.points_a), cloud(file.points_b), options, random);
  MotionEstimate estimate;
  estimate.outcome = found.outcome;
  if (found.outcome) {
    estimate.T_ref_cur = found.T_ref_cur;
    estimate.R_ref_cur = found.T_ref_cur.rotation();
    estimate.covariance = found.information.ldlt().solve(Matrix6d::Identity());
  }
  estimate.metric = true;
  estimate.inliers = found.inliers;
  estimate.evidence = {{"chi2_per_dof", found.chi2_per_dof}};
  return estimate;
}

}  // namespace placegraph::apps
