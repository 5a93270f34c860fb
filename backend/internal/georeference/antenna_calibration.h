#pragma once
#include <placegraph/backend/internal/georeference/antenna_trajectory.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/pose_graph/pose_graph.h>

#include <vector>

namespace placegraph {

/// A fix as an observation of its node in the world's frame.
struct AntennaObservation {
  InterpolatedFix fix;
  Eigen::Vector3d position_world = Eigen::Vector3d::Zero();
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity();
};

/// The antenna by `graph` (T_world_node) and `calibration` (lever arm [m], clock offset [s]) minus
/// where it was seen, [m]; of a planar graph without the height.
Eigen::Vector3d residual_of(const AntennaObservation& seen, const PoseGraph& graph,
                            const Eigen::Vector4d& calibration);

/// What all fixes have in common: [lever arm (3) [m], clock offset [s]], Gaussian.
struct AntennaCalibration {
  Eigen::Vector4d value = Eigen::Vector4d::Zero();
  Eigen::Vector4d sigma = Eigen::Vector4d::Zero();  ///< of the prior; 0: known, not estimated
};

struct AntennaCalibrationResult {
  Outcome outcome;
  Eigen::Vector4d value = Eigen::Vector4d::Zero();
  /// With the prior; rows and columns of what is known are zero.
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
  PoseGraph graph;  ///< with the optimized poses
  int iterations = 0;
};

/// Minimizes the cost of the graph's relative poses, of the observations under `kernel` and of the
/// prior, over all poses and the calibration together. The covariance is the Schur complement of
/// the poses in the normal equations at the minimum. A lever arm is observable only across axes the
/// vehicle turns about; where it is not, the covariance stays that of the prior. kNotConverged as
/// the pose-graph optimizer; kDegenerate if the normal equations are singular.
[[nodiscard]] AntennaCalibrationResult calibrate_antenna(
    const PoseGraph& graph, const std::vector<AntennaObservation>& observations,
    const RobustKernel& kernel, const AntennaCalibration& prior, const Eigen::Vector4d& start,
    int max_iterations);

}  // namespace placegraph
