#pragma once
#include <placegraph/backend/georeference/antenna_trajectory.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/pose_graph/pose_graph.h>

#include <vector>

namespace placegraph {

/// A fix as an observation of the antenna from its node, in the world's frame.
struct AntennaObservation {
  InterpolatedFix fix;
  Eigen::Vector3d position_world = Eigen::Vector3d::Zero();
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity();
};

/// Estimated minus observed position of the antenna [m].
/// The estimate is by `graph` (T_world_node) and `calibration` (lever arm [m], clock offset [s]);
/// the height of a planar graph is left out.
Eigen::Vector3d residual_of(const AntennaObservation& seen, const PoseGraph& graph,
                            const Eigen::Vector4d& calibration);

/// Gaussian calibration shared by all fixes: [lever arm (3) [m], clock offset [s]].
struct AntennaCalibration {
  Eigen::Vector4d value = Eigen::Vector4d::Zero();
  Eigen::Vector4d sigma = Eigen::Vector4d::Zero();  ///< prior sigmas; 0: known, not estimated
};

struct AntennaCalibrationResult {
  Outcome outcome;
  Eigen::Vector4d value = Eigen::Vector4d::Zero();
  /// Covariance including the prior; rows and columns of known components are zero.
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
  PoseGraph graph;  ///< graph with the optimized poses
  int iterations = 0;
};

/// Estimates the poses and the calibration jointly.
/// It minimizes the cost of the graph's relative poses, of the observations under `kernel` and of
/// the prior. The covariance is the Schur complement of the poses in the normal equations at the
/// minimum. A lever arm is observable only across the axes about which the vehicle rotates;
/// otherwise its covariance stays that of the prior. kNotConverged as the pose-graph optimizer;
/// kDegenerate if the normal equations are singular.
[[nodiscard]] AntennaCalibrationResult calibrate_antenna(
    const PoseGraph& graph, const std::vector<AntennaObservation>& observations,
    const RobustKernel& kernel, const AntennaCalibration& prior, const Eigen::Vector4d& start,
    int max_iterations);

}  // namespace placegraph
