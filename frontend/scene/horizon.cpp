#include <placegraph/frontend/scene/horizon.h>
#include <placegraph/frontend/vanishing/vanishing_points.h>
#include <placegraph/graph/core/angle.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

/// Normal equations of two tilts: down = normalize(d + a e1 + b e2).
struct Tilts {
  Eigen::Matrix2d N = Eigen::Matrix2d::Zero();
  Eigen::Vector2d g = Eigen::Vector2d::Zero();
  void add(const Eigen::Vector2d& J, double residual, double weight) {
    N += weight * J * J.transpose();
    g -= weight * J * residual;
  }
};

}  // namespace

void visit(OptionVisitor& field, HorizonOptions& o) {
  field("max_tilt_deg", o.max_tilt_deg, "maximum tilt of the camera", {0.1, 45});
  field("prior_deg", o.prior_deg, "standard deviation of the tilt without any line", {0.01, 45});
  field("structure_deg", o.structure_deg,
        "standard deviation of upright and level edges of a street", {0.01, 10});
  field.group("vanishing", o.vanishing, "search for vanishing points");
}

Horizon estimate_horizon(const std::vector<LineSegment>& segments, const Camera& camera,
                         const HorizonOptions& options, Random& random) {
  options.check();
  const VanishingPoints found = find_vanishing_points(segments, camera, options.vanishing, random);
  Horizon horizon;
  const Eigen::Vector3d level = Eigen::Vector3d::UnitY();
  const double most = std::sin(options.max_tilt_deg * kRadPerDeg);
  const double structure = std::pow(options.structure_deg * kRadPerDeg, 2);
  Tilts tilts;
  // Iterations at most. Chosen.
  constexpr int kRounds = 15;
  for (int round = 0; round < kRounds; ++round) {
    Eigen::Matrix<double, 3, 2> basis;
    basis.col(0) = horizon.down.cross(Eigen::Vector3d::UnitZ()).normalized();
    basis.col(1) = horizon.down.cross(basis.col(0));
    tilts = {};
    horizon.directions = 0;
    const double prior = 1 / std::pow(options.prior_deg * kRadPerDeg, 2);
    for (int i = 0; i < 2; ++i)
      tilts.add(Eigen::Vector2d::Unit(i), -basis.col(i).dot(level), prior);
    for (const VanishingPoint& point : found.points) {
      const double variance = structure + point.covariance.trace() / 2;
      // Cauchy: roofs, ramps and stairs are neither upright nor level.
      const auto weight = [&](double r) { return 1 / (variance + r * r); };
      if (std::abs(point.direction.y()) > std::sqrt(1 - most * most)) {
        const Eigen::Vector3d up_or_down =
            point.direction.y() > 0 ? point.direction : -point.direction;
        for (int i = 0; i < 2; ++i) {
          const double r = -basis.col(i).dot(up_or_down);
          tilts.add(Eigen::Vector2d::Unit(i), r, weight(r));
        }
        ++horizon.directions;
      } else if (std::abs(point.direction.y()) < most) {
        const double r = point.direction.dot(horizon.down);
        tilts.add(basis.transpose() * point.direction, r, weight(r));
        ++horizon.directions;
      }
    }
    const Eigen::Vector2d step = tilts.N.ldlt().solve(tilts.g);
    horizon.down = (horizon.down + basis * step).normalized();
    if (step.norm() < 1e-9) break;
  }
  const Eigen::Matrix2d covariance = tilts.N.inverse();
  horizon.sigma_deg =
      std::sqrt(covariance.selfadjointView<Eigen::Lower>().eigenvalues().maxCoeff()) / kRadPerDeg;
  horizon.outcome = horizon.directions > 0
                        ? Outcome::ok()
                        : Outcome::failure(Outcome::Code::kTooFewData, "no level or upright edges");
  return horizon;
}

}  // namespace placegraph
