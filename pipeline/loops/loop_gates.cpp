#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/chi_squared.h>
#include <placegraph/pipeline/loops/loop_gates.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace placegraph {
namespace {

// Maximum disagreement of two loops that support each other: in translation, over (median depth +
// path length between them), and in rotation. Chosen.
constexpr double kSupportTranslation = 0.03, kSupportAngle_deg = 2;

}  // namespace

Drift drift_over(double path_length, double distance, double median_depth_m,
                 const LoopOptions& options) {
  const double depths = path_length / median_depth_m;
  Drift drift;
  drift.angle_rad =
      std::min(std::numbers::pi, deg_to_rad(kSupportAngle_deg + options.drift_angle_deg * depths));
  drift.length =
      options.drift_translation * (median_depth_m + path_length) + drift.angle_rad * 0.5 * distance;
  drift.log_scale = kMaxLoopScaleError + options.drift_scale * depths;
  return drift;
}

bool within_reach(const TrackedMotion& odometry, double farthest, double median_depth_m,
                  const LoopOptions& options) {
  const double distance = odometry.T_a_b.translation().norm();
  return distance <= kMaxLoopBaseline_depths * farthest +
                         drift_over(odometry.path_length, distance, median_depth_m, options).length;
}

bool within_drift(const Loop& loop, const TrackedMotion& odometry, double median_depth_m,
                  bool free_scale, const LoopOptions& options) {
  const SE3 difference = odometry.T_a_b.inverse() * loop.T_match_query;
  Drift most = drift_over(odometry.path_length, odometry.T_a_b.translation().norm(), median_depth_m,
                          options);
  if (free_scale) {
    if (std::abs(std::log(loop.scale_match_query)) > most.log_scale) return false;
    // A scale that changed during a round trip leaves it open by a share of its length.
    most.length += std::abs(std::expm1(std::log(loop.scale_match_query))) * odometry.path_length;
  }
  return difference.translation().norm() <= most.length &&
         difference.rotation().log().norm() <= most.angle_rad;
}

bool within_covariance(const Loop& loop, const PredictedMotion& predicted, double median_depth_m,
                       const LoopOptions& options) {
  static const double chi2 = chi_squared_quantile(0.999, 6);
  constexpr double kSigmas = 3;  // maximum drift in standard deviations
  const Vector7d error = (predicted.S_a_b.inverse() * loop.S_match_query()).log();
  const Drift most = drift_over(predicted.path_length, predicted.S_a_b.translation().norm(),
                                median_depth_m, options);
  Vector6d drift;
  drift << Eigen::Vector3d::Constant(most.length), Eigen::Vector3d::Constant(most.angle_rad);
  const bool free_scale = loop.information(6, 6) > 0;
  if (free_scale &&
      std::abs(error[6]) > most.log_scale + kSigmas * std::sqrt(predicted.covariance(6, 6)))
    return false;
  Matrix7d information = loop.information;
  if (!free_scale) information(6, 6) = 1;
  const Eigen::LLT<Matrix7d> factor(information);
  if (factor.info() != Eigen::Success) return true;
  Matrix6d covariance = predicted.covariance.topLeftCorner<6, 6>();
  covariance += factor.solve(Matrix7d::Identity()).topLeftCorner<6, 6>();
  covariance.diagonal() += (drift / kSigmas).cwiseAbs2();
  return error.head<6>().dot(covariance.ldlt().solve(error.head<6>())) < chi2;
}

bool agree(const Loop& a, const Loop& b, const TrackedMotion& queries, const TrackedMotion& matches,
           double median_depth_m) {
  const Sim3 predicted = Sim3(matches.T_a_b.inverse()) * a.S_match_query() * Sim3(queries.T_a_b);
  // In the query's scale, as the median depth.
  const Sim3 difference = predicted.inverse() * b.S_match_query();
  const double path_length = queries.path_length + matches.path_length / predicted.scale();
  return difference.translation().norm() < kSupportTranslation * (median_depth_m + path_length) &&
         difference.rotation().log().norm() < deg_to_rad(kSupportAngle_deg) &&
         std::abs(std::log(difference.scale())) < kMaxLoopScaleError;
}

}  // namespace placegraph
