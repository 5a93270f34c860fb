#include <placegraph/frontend/markers/beacon_pose.h>
#include <placegraph/frontend/markers/square_pose.h>
#include <placegraph/graph/core/chi_squared.h>

#include <Eigen/LU>
#include <algorithm>
#include <opengv/absolute_pose/CentralAbsoluteAdapter.hpp>
#include <opengv/absolute_pose/methods.hpp>

namespace placegraph {
namespace {

using Code = Outcome::Code;
using Triple = std::array<int, 3>;

/// Pixel of a point and its covariance from that of the pose.
struct Expected {
  Eigen::Vector2d px;
  Eigen::Matrix2d covariance;
};
std::optional<Expected> expect(const Camera& camera, const SE3& T_world_cam,
                               const Matrix6d& covariance, const Eigen::Vector3d& point_world) {
  const Eigen::Vector3d p_cam = T_world_cam.inverse() * point_world;
  Eigen::Matrix<double, 2, 3> J_px_cam;
  const auto px = camera.project(p_cam, &J_px_cam);
  if (!px) return std::nullopt;
  Eigen::Matrix<double, 3, 6> J_cam_xi;
  J_cam_xi << -Eigen::Matrix3d::Identity(), hat(p_cam);
  const Eigen::Matrix<double, 2, 6> J = J_px_cam * J_cam_xi;
  return Expected{*px, J * covariance * J.transpose()};
}

int beacons_in_view(const Camera& camera, const SE3& T_world_cam,
                    const std::vector<Eigen::Vector3d>& beacons_world) {
  // Margin of the border. Chosen.
  constexpr double kBorder_px = 5;
  int count = 0;
  for (const Eigen::Vector3d& beacon : beacons_world) {
    const auto px = camera.project(T_world_cam.inverse() * beacon);
    if (px && camera.contains(*px, kBorder_px)) ++count;
  }
  return count;
}

std::vector<SeenPoint> seen_points(const std::vector<BeaconObservation>& spots,
                                   const std::vector<Eigen::Vector3d>& beacons_world,
                                   const BeaconPairs& pairs) {
  std::vector<SeenPoint> points;
  for (const auto& [spot, beacon] : pairs)
    points.push_back({spots[spot].px, beacons_world[beacon], spots[spot].covariance.inverse()});
  return points;
}

/// Refines the pose with reassigned pairs; empty pairs if this fails.
BeaconPose refined(const std::vector<BeaconObservation>& spots,
                   const std::vector<Eigen::Vector3d>& beacons_world, const Camera& camera,
                   const SE3& T_world_cam, const BeaconPoseOptions& options) {
  BeaconPose result;
  // A pose from three spots has about their error: 1 % of the range and 0.01 rad are a generous
  // bound.
  Matrix6d covariance = Matrix6d::Zero();
  const double range = (beacons_world.front() - T_world_cam.translation()).norm();
  covariance.diagonal() << Eigen::Vector3d::Constant(std::pow(0.01 * range, 2)),
      Eigen::Vector3d::Constant(std::pow(0.01, 2));
  result.T_world_cam = T_world_cam;
  for (int round = 0; round < 2; ++round) {
    result.pairs =
        assign_beacons(spots, beacons_world, camera, result.T_world_cam, covariance, options);
    const SquarePose pose = refine_square_pose(
        camera, {}, seen_points(spots, beacons_world, result.pairs), result.T_world_cam);
    if (!pose.outcome) {
      result.outcome = pose.outcome;
      result.pairs.clear();
      return result;
    }
    result.T_world_cam = pose.T_ref_cam;
    result.covariance = covariance = pose.covariance;
    result.chi2 = pose.chi2;
  }
  result.outcome = Outcome::ok();
  return result;
}

bool same_pose(const SE3& a, const SE3& b, double range_m) {
  // Shares of the range and angles that are one pose. Chosen.
  constexpr double kSame = 1e-3;
  const SE3 between = a.inverse() * b;
  return between.translation().norm() < kSame * range_m && between.rotation().log().norm() < kSame;
}

/// All poses from assignments of three spots to three beacons that explain enough spots.
class AssignmentSearch {
 public:
  AssignmentSearch(const std::vector<BeaconObservation>& spots,
                   const std::vector<Eigen::Vector3d>& beacons_world, const Camera& camera,
                   const BeaconPoseOptions& options)
      : spots_(spots), beacons_(beacons_world), camera_(camera), options_(options) {
    for (const BeaconObservation& spot : spots) {
      const auto ray = camera.unproject(spot.px);
      rays_.push_back(ray ? ray->normalized() : Eigen::Vector3d::UnitZ());
    }
  }

  std::vector<BeaconPose> run() {
    const int n = static_cast<int>(spots_.size()), m = static_cast<int>(beacons_.size());
    for (int a = 0; a < n; ++a)
      for (int b = a + 1; b < n; ++b)
        for (int c = b + 1; c < n; ++c)
          for (int i = 0; i < m; ++i)
            for (int j = 0; j < m; ++j)
              for (int k = 0; k < m; ++k) {
                if (i == j || j == k || i == k) continue;
                if (++trials_ > options_.max_trials) return found_;
                try_one({a, b, c}, {i, j, k});
              }
    return found_;
  }

 private:
  void try_one(const Triple& spots, const Triple& beacons) {
    opengv::bearingVectors_t bearings;
    opengv::points_t points;
    for (int k = 0; k < 3; ++k) {
      bearings.push_back(rays_[spots[k]]);
      points.push_back(beacons_[beacons[k]]);
    }
    const opengv::absolute_pose::CentralAbsoluteAdapter adapter(bearings, points);
    for (const auto& T : opengv::absolute_pose::p3p_kneip(adapter)) {
      const Eigen::Matrix3d R = T.leftCols<3>();
      if (!T.allFinite() || (R.transpose() * R - Eigen::Matrix3d::Identity()).norm() > 1e-3)
        continue;
      consider(SE3(R, Eigen::Vector3d(T.col(3))));
    }
  }
  void consider(const SE3& T_world_cam) {
    if (rough_count(T_world_cam) < options_.min_spots) return;
    BeaconPose pose = refined(spots_, beacons_, camera_, T_world_cam, options_);
    const auto count = static_cast<int>(pose.pairs.size());
    if (!pose.outcome || count < options_.min_spots) return;
    if (pose.chi2 > chi_squared_quantile(options_.gate, 2 * count)) return;
    const int in_view = beacons_in_view(camera_, pose.T_world_cam, beacons_);
    if (in_view - count > options_.max_missed * in_view) return;
    const double range = (beacons_.front() - pose.T_world_cam.translation()).norm();
    for (const BeaconPose& known : found_)
      if (same_pose(known.T_world_cam, pose.T_world_cam, range)) return;
    found_.push_back(std::move(pose));
  }
  /// Number of spots with a beacon within some pixels; it rejects most assignments.
  int rough_count(const SE3& T_world_cam) const {
    // Distance of a spot that may be the beacon. Chosen.
    constexpr double kNear_px = 4;
    const SE3 T_cam_world = T_world_cam.inverse();
    int count = 0;
    std::vector<Eigen::Vector2d> expected;
    for (const Eigen::Vector3d& beacon : beacons_)
      if (const auto px = camera_.project(T_cam_world * beacon)) expected.push_back(*px);
    for (const BeaconObservation& spot : spots_)
      count += std::any_of(expected.begin(), expected.end(), [&](const Eigen::Vector2d& px) {
        return (px - spot.px).squaredNorm() < kNear_px * kNear_px;
      });
    return count;
  }

  const std::vector<BeaconObservation>& spots_;
  const std::vector<Eigen::Vector3d>& beacons_;
  const Camera& camera_;
  const BeaconPoseOptions& options_;
  std::vector<Eigen::Vector3d> rays_;
  std::vector<BeaconPose> found_;
  int trials_ = 0;
};

}  // namespace

BeaconPairs assign_beacons(const std::vector<BeaconObservation>& spots,
                           const std::vector<Eigen::Vector3d>& beacons_world, const Camera& camera,
                           const SE3& T_world_cam, const Matrix6d& covariance,
                           const BeaconPoseOptions& options) {
  const double gate = chi_squared_quantile(options.gate, 2);
  BeaconPairs near;
  std::vector<int> of_spot(spots.size(), 0), of_beacon(beacons_world.size(), 0);
  for (std::size_t b = 0; b < beacons_world.size(); ++b) {
    const auto expected = expect(camera, T_world_cam, covariance, beacons_world[b]);
    if (!expected) continue;
    for (std::size_t s = 0; s < spots.size(); ++s) {
      const Eigen::Vector2d r = spots[s].px - expected->px;
      const Eigen::Matrix2d S = expected->covariance + spots[s].covariance;
      if (!(r.dot(S.inverse() * r) < gate)) continue;
      near.emplace_back(static_cast<int>(s), static_cast<int>(b));
      ++of_spot[s];
      ++of_beacon[b];
    }
  }
  std::erase_if(near, [&](const std::pair<int, int>& pair) {
    return of_spot[pair.first] > 1 || of_beacon[pair.second] > 1;
  });
  return near;
}

BeaconPose find_beacon_pose(const std::vector<BeaconObservation>& spots,
                            const std::vector<Eigen::Vector3d>& beacons_world, const Camera& camera,
                            const BeaconPoseOptions& options) {
  options.check();
  BeaconPose result;
  const std::size_t least = static_cast<std::size_t>(options.min_spots);
  if (spots.size() < least || beacons_world.size() < least) {
    result.outcome =
        Outcome::failure(Code::kTooFewData, std::to_string(spots.size()) + " spots, " +
                                                std::to_string(beacons_world.size()) + " beacons");
    return result;
  }
  std::vector<BeaconPose> found = AssignmentSearch(spots, beacons_world, camera, options).run();
  if (found.empty()) {
    result.outcome = Outcome::failure(Code::kNoConsensus, "no assignment explains the spots");
    return result;
  }
  // Each explained spot is worth the cost of a spot at the gate.
  const double spot_worth = chi_squared_quantile(options.gate, 2);
  const auto cost = [&](const BeaconPose& pose) {
    return pose.chi2 - spot_worth * static_cast<double>(pose.pairs.size());
  };
  std::sort(found.begin(), found.end(),
            [&](const BeaconPose& a, const BeaconPose& b) { return cost(a) < cost(b); });
  const bool ambiguous = found.size() > 1 && cost(found[1]) - cost(found[0]) < options.min_margin;
  result = std::move(found[0]);
  result.outcome =
      ambiguous ? Outcome::failure(Code::kInconsistent, "two different poses explain the spots")
                : Outcome::ok();
  return result;
}

}  // namespace placegraph
