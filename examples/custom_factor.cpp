// A custom factor: ranges from three beacons to a robot are combined with its odometry.
#include <placegraph/backend/factor_graph/factor_graph.h>
#include <placegraph/backend/factors/relative_pose.h>

#include <cmath>
#include <cstdio>

using namespace placegraph;

/// r = (|p - t| - range) / sigma of a pose T_world_robot = (R, t) and a beacon p; u = (p - t)/|p -
/// t|: d r / d xi = [-u^T R, 0] / sigma, d r / d p = u^T / sigma.
class BeaconRange final : public SizedFactor<1, SE3, Eigen::Vector3d> {
 public:
  BeaconRange(double range_m, double sigma_m) : range_m_(range_m), sigma_m_(sigma_m) {}

  bool compute(const SE3& T_world_robot, const Eigen::Vector3d& p_world, Residual& r,
               Jacobians* J) const override {
    const Eigen::Vector3d offset = p_world - T_world_robot.translation();
    const double length = offset.norm();
    if (length == 0) return false;  // no direction: the solver tries a shorter step
    r[0] = (length - range_m_) / sigma_m_;
    if (!J) return true;
    const Eigen::RowVector3d u = offset.transpose() / (length * sigma_m_);
    std::get<0>(*J) << -u * T_world_robot.rotation().matrix(), 0, 0, 0;
    std::get<1>(*J) = u;
    return true;
  }

 private:
  double range_m_, sigma_m_;
};

int main() {
  FactorGraph graph;
  const int start = graph.add_variable(SE3(), true);
  const int robot = graph.add_variable(SE3(SO3(), {1.5, 0.5, 0}));
  Matrix6d whitening = Matrix6d::Identity();  // odometry: 1 m, 0.01 rad
  whitening.diagonal().tail<3>().setConstant(100);
  graph.add(RelativePoseFactor<SE3>(SE3(SO3(), {1.8, 0.1, 0}), whitening), {start, robot});
  const Eigen::Vector3d truth(2, 0, 0);
  for (const Eigen::Vector3d& beacon : {Eigen::Vector3d(5, 5, 1), {5, -5, 1}, {-5, 0, 3}})
    graph.add(BeaconRange((beacon - truth).norm(), 0.01), {robot, graph.add_variable(beacon, true)},
              {RobustKernel::Kind::kHuber, 3.0});

  const FactorGraphReport report = optimize_factor_graph(graph, {});
  const MarginalCovariance marginal = marginal_covariance(report.graph, {robot});
  if (!report.outcome || !marginal.outcome) return 1;
  const Eigen::Vector3d t = report.graph.value<SE3>(robot).translation();
  std::printf("robot at %.3f %.3f %.3f m, sigma %.3f %.3f %.3f m, %d iterations\n", t.x(), t.y(),
              t.z(), std::sqrt(marginal.covariance(0, 0)), std::sqrt(marginal.covariance(1, 1)),
              std::sqrt(marginal.covariance(2, 2)), report.iterations);
}
