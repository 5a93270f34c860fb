#include <placegraph/backend/georeference/gps_alignment.h>
#include <placegraph/graph/core/angle.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <numbers>
#include <numeric>

namespace placegraph {
namespace {

constexpr double kGate = 3.0;  ///< standard deviations
// Chosen: a majority.
constexpr double kMinInlierShare = 0.5;

/// Least-squares rotation about the vertical and translation, without heights.
Sim3 fit_planar(const Eigen::Matrix3Xd& map, const Eigen::Matrix3Xd& enu) {
  const Eigen::Vector3d mean_map = map.rowwise().mean(), mean_enu = enu.rowwise().mean();
  const Eigen::Matrix3Xd a = map.colwise() - mean_map, b = enu.colwise() - mean_enu;
  const double along = (a.topRows<2>().array() * b.topRows<2>().array()).sum();
  const double across =
      (a.row(0).array() * b.row(1).array() - a.row(1).array() * b.row(0).array()).sum();
  const SO3 R_enu_map = SO3::exp({0, 0, std::atan2(across, along)});
  Eigen::Vector3d t_enu_map = mean_enu - R_enu_map * mean_map;
  t_enu_map[2] = 0;
  return Sim3(R_enu_map, t_enu_map, 1);
}

/// Least-squares fit of the chosen pairs.
Sim3 fit(const std::vector<PositionPair>& pairs, const std::vector<int>& chosen,
         AlignmentGroup group) {
  const auto n = static_cast<Eigen::Index>(chosen.size());
  Eigen::Matrix3Xd map(3, n), enu(3, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const PositionPair& pair = pairs[static_cast<std::size_t>(chosen[static_cast<std::size_t>(i)])];
    map.col(i) = pair.map;
    enu.col(i) = pair.enu;
  }
  if (group == AlignmentGroup::kPlanar) return fit_planar(map, enu);
  const bool scaled = group == AlignmentGroup::kSimilarity;
  const Eigen::Matrix4d T = Eigen::umeyama(map, enu, scaled);
  const double scale = scaled ? T.topLeftCorner<3, 1>().norm() : 1.0;
  return Sim3(SO3::from_matrix(T.topLeftCorner<3, 3>() / scale), T.topRightCorner<3, 1>(), scale);
}

/// Whether a sample determines a rotation (and a scale), as fit() requires.
bool usable(const std::vector<PositionPair>& pairs, const std::vector<int>& sample,
            AlignmentGroup group) {
  const Eigen::Vector3d a = pairs[sample[1]].map - pairs[sample[0]].map;
  if (group == AlignmentGroup::kPlanar) return a.head<2>().norm() > 1e-9;
  const Eigen::Vector3d b = pairs[sample[2]].map - pairs[sample[0]].map;
  const double size = a.norm() * b.norm();
  if (!(size > 1e-12) || !(a.cross(b).norm() > 1e-6 * size)) return false;
  const Eigen::Vector3d c = pairs[sample[1]].enu - pairs[sample[0]].enu;
  return group != AlignmentGroup::kSimilarity || c.norm() > 1e-9;
}

/// Standard deviation of the rotation about the axis along which the positions spread most.
double angle_sigma_deg(const std::vector<PositionPair>& pairs, const std::vector<int>& inliers,
                       AlignmentGroup group, double scale) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  double variance = 0;
  for (const int i : inliers) {
    mean += pairs[i].map;
    variance += pairs[i].sigma_m * pairs[i].sigma_m;
  }
  const double n = static_cast<double>(inliers.size());
  mean /= n;
  Eigen::Matrix3d dispersion = Eigen::Matrix3d::Zero();
  for (const int i : inliers) {
    const Eigen::Vector3d d = pairs[i].map - mean;
    dispersion += d * d.transpose();
  }
  if (group == AlignmentGroup::kPlanar) {
    dispersion.row(2).setZero();
    dispersion.col(2).setZero();
  }
  const Eigen::Vector3d spread =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(dispersion, Eigen::EigenvaluesOnly)
          .eigenvalues();
  // The lever arm about axis k is the spread along the two other axes.
  const double across =
      scale * scale *
      (group == AlignmentGroup::kPlanar ? spread[1] + spread[2] : spread[0] + spread[1]);
  if (!(across > 1e-18 * scale * scale * spread[2])) return 180;
  const double sigma = std::sqrt(variance / n / across);
  return std::min(180.0, rad_to_deg(sigma));
}

double path_length(const std::vector<PositionPair>& pairs) {
  double length = 0;
  for (std::size_t i = 1; i < pairs.size(); ++i) length += (pairs[i].map - pairs[i - 1].map).norm();
  return length;
}

}  // namespace

AlignmentGroup alignment_group(PoseKind kind) {
  return kind == PoseKind::kSE2   ? AlignmentGroup::kPlanar
         : kind == PoseKind::kSE3 ? AlignmentGroup::kRigid
                                  : AlignmentGroup::kSimilarity;
}

GpsAlignment align_to_fixes(const std::vector<PositionPair>& pairs, AlignmentGroup group,
                            const GpsAlignmentOptions& options, Random& random) {
  const double bend_m = 0.01 * options.max_bend_percent * path_length(pairs);
  const int sample_size = group == AlignmentGroup::kPlanar ? 2 : 3;
  const auto found = ransac<Sim3>(
      static_cast<int>(pairs.size()), sample_size, kGate * kGate, options.ransac, random,
      [&](const std::vector<int>& sample) {
        return usable(pairs, sample, group) ? std::vector<Sim3>{fit(pairs, sample, group)}
                                            : std::vector<Sim3>{};
      },
      [&](const Sim3& T_enu_map, int i) {
        Eigen::Vector3d e = T_enu_map * pairs[i].map - pairs[i].enu;
        if (group == AlignmentGroup::kPlanar) e[2] = 0;
        // The deformation is a bound, not a standard deviation: a third of it for a gate of three.
        const double sigma = pairs[i].sigma_m;
        return e.squaredNorm() / (sigma * sigma + bend_m * bend_m / (kGate * kGate));
      },
      [&](const Sim3& model, const std::vector<int>& inliers) {
        return static_cast<int>(inliers.size()) > sample_size ? fit(pairs, inliers, group) : model;
      });
  GpsAlignment result;
  result.outcome = found.outcome;
  if (found.inliers.empty()) {
    if (result.outcome.code == Outcome::Code::kTooFewData) return result;
    std::vector<int> all(pairs.size());
    std::iota(all.begin(), all.end(), 0);
    result.angle_sigma_deg = angle_sigma_deg(pairs, all, group, 1);
    result.outcome =
        result.angle_sigma_deg > options.max_angle_sigma_deg
            ? Outcome::failure(Outcome::Code::kDegenerate,
                               "the positions coincide or are on a line: alignment undetermined")
            : Outcome::failure(Outcome::Code::kNoConsensus,
                               "no fixes agree on an alignment of the map");
    return result;
  }
  result.T_enu_map = found.model;
  result.inliers = found.inliers;
  double squares = 0;
  for (const int i : found.inliers) {
    Eigen::Vector3d e = found.model * pairs[i].map - pairs[i].enu;
    if (group == AlignmentGroup::kPlanar) e[2] = 0;
    squares += e.squaredNorm();
  }
  result.rmse_m = std::sqrt(squares / static_cast<double>(found.inliers.size()));
  result.angle_sigma_deg = angle_sigma_deg(pairs, found.inliers, group, found.model.scale());
  const double share =
      static_cast<double>(found.inliers.size()) / static_cast<double>(pairs.size());
  if ((result.outcome || result.outcome.code == Outcome::Code::kNoConsensus) &&
      share < kMinInlierShare)
    result.outcome = Outcome::failure(Outcome::Code::kNoConsensus,
                                      std::to_string(found.inliers.size()) + " of " +
                                          std::to_string(pairs.size()) +
                                          " fixes agree on an alignment of the map");
  if (result.outcome && result.angle_sigma_deg > options.max_angle_sigma_deg)
    result.outcome = Outcome::failure(
        Outcome::Code::kDegenerate,
        "the positions are nearly on a line: the standard deviation of the rotation about it is " +
            std::to_string(result.angle_sigma_deg) + " deg");
  return result;
}

}  // namespace placegraph
