#include <placegraph/eval/alignment/umeyama.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/SVD>
#include <cmath>

namespace placegraph {
namespace {

// Ratio of singular values of the positions' covariance below which a direction counts as absent:
// spreads of 1e-5, 1 mm across for 100 m along.
constexpr double kRankTolerance = 1e-10;

double rmse_after(const AlignmentResult& a, const std::vector<Eigen::Vector3d>& from,
                  const std::vector<Eigen::Vector3d>& to) {
  double squares = 0;
  for (std::size_t i = 0; i < from.size(); ++i)
    squares +=
        (to[i] - (a.scale * (a.R_truth_estimate * from[i]) + a.t_truth_estimate)).squaredNorm();
  return std::sqrt(squares / static_cast<double>(from.size()));
}

Eigen::Vector3d mean_of(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

}  // namespace

Eigen::Isometry3d AlignmentResult::apply(const Eigen::Isometry3d& T_world_estimate) const {
  Eigen::Isometry3d T_world_aligned = Eigen::Isometry3d::Identity();
  T_world_aligned.linear() = R_truth_estimate * T_world_estimate.linear();
  T_world_aligned.translation() =
      scale * (R_truth_estimate * T_world_estimate.translation()) + t_truth_estimate;
  return T_world_aligned;
}

AlignmentResult umeyama(const std::vector<Eigen::Vector3d>& points_from,
                        const std::vector<Eigen::Vector3d>& points_to, bool with_scale) {
  require(points_from.size() == points_to.size(), "umeyama: lists of different length");
  AlignmentResult result;
  result.pairs = static_cast<int>(points_from.size());
  if (result.pairs < 3) {
    result.outcome = Outcome::failure(
        Outcome::Code::kTooFewData,
        std::to_string(result.pairs) + " associated poses, the alignment needs 3");
    return result;
  }
  const Eigen::Vector3d mean_from = mean_of(points_from), mean_to = mean_of(points_to);
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double variance_from = 0, variance_to = 0;
  for (std::size_t i = 0; i < points_from.size(); ++i) {
    covariance += (points_to[i] - mean_to) * (points_from[i] - mean_from).transpose();
    variance_from += (points_from[i] - mean_from).squaredNorm();
    variance_to += (points_to[i] - mean_to).squaredNorm();
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Vector3d d = svd.singularValues();
  // Coincident points leave rounding noise only: compare with the positions' own size.
  const double floor_m2 = 1e-24 * (mean_from.squaredNorm() + mean_to.squaredNorm() + 1e-300) *
                          static_cast<double>(result.pairs);
  result.rank = d[0] > floor_m2 ? static_cast<int>((d.array() > kRankTolerance * d[0]).count()) : 0;
  Eigen::Vector3d sign(1, 1,
                       svd.matrixU().determinant() * svd.matrixV().determinant() < 0 ? -1 : 1);
  if (result.rank > 0) {
    result.R_truth_estimate = svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
    if (with_scale) result.scale = d.dot(sign) / variance_from;
    const double common = d.dot(sign);
    if (variance_from > 0 && variance_to > 0)
      result.explained = common * common / (variance_from * variance_to);
    // A reflection adds twice the smallest singular value to what both have in common.
    const double left_m2 = variance_to + result.scale * result.scale * variance_from -
                           2 * result.scale * common;
    const double gain_m2 = sign[2] < 0 ? 4 * result.scale * d[2] : 0;
    result.mirrored = result.rank == 3 && gain_m2 >= 0.75 * left_m2 && left_m2 > 0;
    if (result.rank == 1) result.free_axes = {svd.matrixU().col(0)};
  }
  result.t_truth_estimate = mean_to - result.scale * (result.R_truth_estimate * mean_from);
  result.rmse_m = rmse_after(result, points_from, points_to);
  // Positions that fit as they are stay what they are: no similarity, but for rounding, is better.
  if (const double unmoved_m = rmse_after({}, points_from, points_to); unmoved_m <= result.rmse_m) {
    result.scale = 1;
    result.R_truth_estimate.setIdentity();
    result.t_truth_estimate.setZero();
    result.rmse_m = unmoved_m;
  }
  if (result.rank >= 2)
    result.outcome = Outcome::ok();
  else
    result.outcome = Outcome::failure(
        Outcome::Code::kDegenerate,
        result.rank == 1 ? "the positions lie on a line: the rotation about it is not determined"
                         : "the positions coincide: nothing to align by");
  return result;
}

}  // namespace placegraph
