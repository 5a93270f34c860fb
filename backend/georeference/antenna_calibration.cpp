#include <ceres/crs_matrix.h>
#include <ceres/problem.h>
#include <ceres/solver.h>
#include <placegraph/backend/factors/relative_pose.h>
#include <placegraph/backend/georeference/antenna_calibration.h>
#include <placegraph/backend/georeference/antenna_position.h>
#include <placegraph/backend/linear/blas_threads.h>
#include <placegraph/backend/linear/sparse_algebra.h>
#include <placegraph/backend/linear/whitening.h>
#include <placegraph/backend/solver/ceres_factor.h>
#include <placegraph/backend/solver/kernel_loss.h>
#include <placegraph/backend/solver/packed_graph.h>
#include <placegraph/graph/pose_graph/rigid_graph.h>

#include <Eigen/SparseCholesky>
#include <deque>

namespace placegraph {
namespace {

/// r = (c_k - mean) / sigma for the components that are estimated, zero for the others.
class CalibrationPrior final : public ceres::SizedCostFunction<4, 4> {
 public:
  explicit CalibrationPrior(const AntennaCalibration& prior) : prior_(prior) {}
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    if (jacobians && jacobians[0]) Eigen::Map<Eigen::Matrix4d>(jacobians[0]).setZero();
    for (int k = 0; k < 4; ++k) {
      const double inverse = prior_.sigma[k] > 0 ? 1 / prior_.sigma[k] : 0;
      residuals[k] = inverse * (parameters[0][k] - prior_.value[k]);
      if (jacobians && jacobians[0]) jacobians[0][5 * k] = inverse;
    }
    return true;
  }

 private:
  AntennaCalibration prior_;
};

template <class Group>
class CalibrationProblem {
 public:
  static constexpr int kSize = VariableBlock<Group>::kSize;

  CalibrationProblem(const PackedGraph<Group>& graph,
                     const std::vector<AntennaObservation>& observations,
                     const RobustKernel& kernel, const AntennaCalibration& prior,
                     const Eigen::Vector4d& start)
      : poses_(graph.poses.size() * kSize), calibration_(start), problem_(ownership()) {
    for (std::size_t i = 0; i < graph.poses.size(); ++i)
      VariableBlock<Group>::store(graph.poses[i], block(static_cast<int>(i)));
    for (const auto& edge : graph.edges)
      problem_.AddResidualBlock(
          new CeresFactor<RelativePoseFactor<Group>>(RelativePoseFactor<Group>(
              edge.T_to_from.inverse(), whitening(edge.information), RotationError::kLog)),
          loss(edge.kernel), block(edge.from), block(edge.to));
    for (const AntennaObservation& o : observations)
      problem_.AddResidualBlock(
          new AntennaPositionFactor<Group>(o.fix, o.position_world, whitening(o.information)),
          loss(kernel), block(o.fix.node), calibration_.data());
    problem_.AddResidualBlock(new CalibrationPrior(prior), nullptr, calibration_.data());
    std::vector<int> known;
    for (int k = 0; k < 4; ++k)
      if (!(prior.sigma[k] > 0))
        known.push_back(k);
      else
        estimated_.push_back(k);
    if (estimated_.empty())
      problem_.SetParameterBlockConstant(calibration_.data());
    else if (!known.empty())
      problem_.SetManifold(calibration_.data(), new ceres::SubsetManifold(4, known));
    for (std::size_t i = 0; i < graph.poses.size(); ++i) {
      double* const pose = block(static_cast<int>(i));
      if (!problem_.HasParameterBlock(pose)) continue;
      problem_.SetManifold(pose, new VariableManifold<Group>);
      moving_.push_back(pose);
    }
  }

  ceres::Solver::Summary solve(int max_iterations) {
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
    options.sparse_linear_algebra_library_type = kSparseAlgebra;
    options.num_threads = 1;
    options.max_num_iterations = max_iterations;
    options.function_tolerance = 1e-9;
    options.gradient_tolerance = 0;
    options.parameter_tolerance = 0;
    options.max_num_consecutive_invalid_steps = 20;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem_, &summary);
    return summary;
  }

  /// Covariance of the estimated components: inverse of C - B^T A^-1 B, with the normal equations
  /// [A B; B^T C] of poses and calibration. Empty if they are singular.
  std::optional<Eigen::Matrix4d> covariance() {
    Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
    const auto k = static_cast<Eigen::Index>(estimated_.size());
    if (k == 0) return covariance;
    ceres::Problem::EvaluateOptions options;
    options.parameter_blocks = moving_;
    options.parameter_blocks.push_back(calibration_.data());
    ceres::CRSMatrix crs;
    problem_.Evaluate(options, nullptr, nullptr, nullptr, &crs);
    using RowMajor = Eigen::SparseMatrix<double, Eigen::RowMajor>;
    const Eigen::Map<const RowMajor> J(crs.num_rows, crs.num_cols,
                                       static_cast<Eigen::Index>(crs.values.size()),
                                       crs.rows.data(), crs.cols.data(), crs.values.data());
    const Eigen::SparseMatrix<double> columns = J;
    const Eigen::SparseMatrix<double> J_poses = columns.leftCols(crs.num_cols - k);
    const Eigen::MatrixXd J_c = columns.rightCols(k);
    const Eigen::SparseMatrix<double> A = J_poses.transpose() * J_poses;
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(A);
    if (factor.info() != Eigen::Success) return std::nullopt;
    const Eigen::MatrixXd B = J_poses.transpose() * J_c;
    const Eigen::MatrixXd S = J_c.transpose() * J_c - B.transpose() * factor.solve(B);
    const Eigen::LLT<Eigen::MatrixXd> llt(S);
    if (llt.info() != Eigen::Success || !S.allFinite()) return std::nullopt;
    const Eigen::MatrixXd inverse = llt.solve(Eigen::MatrixXd::Identity(k, k));
    for (Eigen::Index i = 0; i < k; ++i)
      for (Eigen::Index j = 0; j < k; ++j) covariance(estimated_[i], estimated_[j]) = inverse(i, j);
    return covariance;
  }

  const Eigen::Vector4d& calibration() const { return calibration_; }
  void read_back(PackedGraph<Group>& graph) {
    for (std::size_t i = 0; i < graph.poses.size(); ++i)
      graph.poses[i] = VariableBlock<Group>::load(block(static_cast<int>(i)));
  }

 private:
  static ceres::Problem::Options ownership() {
    ceres::Problem::Options options;
    options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    return options;
  }
  double* block(int node) { return &poses_[static_cast<std::size_t>(node) * kSize]; }
  ceres::LossFunction* loss(const RobustKernel& kernel) {
    return kernel.kind == RobustKernel::Kind::kNone ? nullptr : &losses_.emplace_back(kernel);
  }

  std::vector<double> poses_;
  Eigen::Vector4d calibration_;
  std::vector<double*> moving_;
  std::vector<int> estimated_;
  std::deque<KernelLoss> losses_;
  ceres::Problem problem_;  // declared after all objects that it points to
};

template <class Group>
AntennaCalibrationResult calibrate(const PoseGraph& graph,
                                   const std::vector<AntennaObservation>& observations,
                                   const RobustKernel& kernel, const AntennaCalibration& prior,
                                   const Eigen::Vector4d& start, int max_iterations) {
  PackedGraph<Group> packed = pack<Group>(graph);
  use_one_blas_thread();
  CalibrationProblem<Group> problem(packed, observations, kernel, prior, start);
  const ceres::Solver::Summary summary = problem.solve(max_iterations);
  AntennaCalibrationResult result;
  result.iterations = std::max(0, static_cast<int>(summary.iterations.size()) - 1);
  result.graph = graph;
  result.value = start;
  result.outcome = summary.termination_type == ceres::CONVERGENCE
                       ? Outcome::ok()
                       : Outcome::failure(Outcome::Code::kNotConverged, summary.message);
  if (!summary.IsSolutionUsable()) return result;
  result.value = problem.calibration();
  problem.read_back(packed);
  packed.components.held.assign(packed.poses.size(), false);
  unpack(packed, result.graph);
  if (const auto covariance = problem.covariance())
    result.covariance = *covariance;
  else if (result.outcome)
    result.outcome = Outcome::failure(Outcome::Code::kDegenerate,
                                      "lever arm: the normal equations are singular");
  return result;
}

}  // namespace

AntennaCalibrationResult calibrate_antenna(const PoseGraph& graph,
                                           const std::vector<AntennaObservation>& observations,
                                           const RobustKernel& kernel,
                                           const AntennaCalibration& prior,
                                           const Eigen::Vector4d& start, int max_iterations) {
  switch (graph.kind()) {
    case PoseKind::kSE2:
      return calibrate<SE2>(graph, observations, kernel, prior, start, max_iterations);
    case PoseKind::kSE3:
      return calibrate<SE3>(graph, observations, kernel, prior, start, max_iterations);
    case PoseKind::kSim3:
      break;
  }
  return calibrate<Sim3>(graph, observations, kernel, prior, start, max_iterations);
}

Eigen::Vector3d residual_of(const AntennaObservation& seen, const PoseGraph& graph,
                            const Eigen::Vector4d& calibration) {
  const Pose& T_world_node = graph.nodes[seen.fix.node].T_world_node;
  const Eigen::Vector3d antenna = seen.fix.antenna(calibration.head<3>(), calibration[3]);
  Eigen::Vector3d e =
      rigid_part(T_world_node) * (scale_of(T_world_node) * antenna) - seen.position_world;
  if (graph.kind() == PoseKind::kSE2) e[2] = 0;
  return e;
}

}  // namespace placegraph
