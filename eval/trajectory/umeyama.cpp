#include <placegraph/eval/trajectory/umeyama.h>
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

Outcome too_few(std::size_t have, int need) {
  return Outcome::failure(
      Outcome::Code::kTooFewData,
      std::to_string(have) + " associated poses, the alignment needs " + std::to_string(need));
}

AlignmentResult align_first_pose(const FramePair& first, const std::vector<Eigen::Vector3d>& from,
                                 const std::vector<Eigen::Vector3d>& to, bool with_scale) {
  AlignmentResult result;
  result.pairs = static_cast<int>(from.size());
  const Eigen::Isometry3d& T_world_truth = first.T_world_truth;
  const Eigen::Isometry3d& T_world_estimate = *first.T_world_estimate;
  if (T_world_truth.linear() != T_world_estimate.linear())
    result.R_truth_estimate = T_world_truth.linear() * T_world_estimate.linear().inverse();
  result.outcome = Outcome::ok();
  if (with_scale) {
    double along = 0, squares = 0;
    for (std::size_t i = 0; i < from.size(); ++i) {
      const Eigen::Vector3d moved = result.R_truth_estimate * (from[i] - from[0]);
      along += moved.dot(to[i] - to[0]);
      squares += moved.squaredNorm();
    }
    if (squares > 0 && along > 0)
      result.scale = along / squares;
    else
      result.outcome = Outcome::failure(
          Outcome::Code::kDegenerate,
          squares > 0 ? "the fitted scale is not positive" : "the estimate never moves: no scale");
  }
  result.t_truth_estimate = to[0] - result.scale * (result.R_truth_estimate * from[0]);
  result.rmse_m = rmse_after(result, from, to);
  return result;
}

}  // namespace

std::string to_string(Alignment alignment) {
  switch (alignment) {
    case Alignment::kNone:
      return "none";
    case Alignment::kOrigin:
      return "origin";
    case Alignment::kSe3:
      return "se3";
    case Alignment::kSim3:
      return "sim3";
    case Alignment::kScale:
      return "scale";
  }
  throw ArgumentError("unknown alignment");
}

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
    result.outcome = too_few(points_from.size(), 3);
    return result;
  }
  const Eigen::Vector3d mean_from = mean_of(points_from), mean_to = mean_of(points_to);
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double variance_from = 0;
  for (std::size_t i = 0; i < points_from.size(); ++i) {
    covariance += (points_to[i] - mean_to) * (points_from[i] - mean_from).transpose();
    variance_from += (points_from[i] - mean_from).squaredNorm();
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

AlignmentResult align(const std::vector<FramePair>& pairs, Alignment alignment) {
  const FramePair* first = nullptr;
  std::vector<Eigen::Vector3d> from, to;
  for (const FramePair& pair : pairs) {
    if (!pair.T_world_estimate) continue;
    if (!first) first = &pair;
    from.push_back(pair.T_world_estimate->translation());
    to.push_back(pair.T_world_truth.translation());
  }
  AlignmentResult result;
  const bool scale_only = alignment == Alignment::kScale;
  if (from.size() < (scale_only ? 2u : 1u)) {
    result.outcome = too_few(from.size(), scale_only ? 2 : 1);
    return result;
  }
  switch (alignment) {
    case Alignment::kNone:
      result.pairs = static_cast<int>(from.size());
      result.rmse_m = rmse_after(result, from, to);
      result.outcome = Outcome::ok();
      return result;
    case Alignment::kOrigin:
    case Alignment::kScale:
      return align_first_pose(*first, from, to, scale_only);
    case Alignment::kSe3:
      return umeyama(from, to, false);
    case Alignment::kSim3:
      return umeyama(from, to, true);
  }
  throw ArgumentError("unknown alignment");
}

}  // namespace placegraph
