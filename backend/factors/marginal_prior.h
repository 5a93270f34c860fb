#pragma once
#include <ceres/cost_function.h>
#include <placegraph/backend/factors/pose_manifold.h>

#include <cstdint>
#include <vector>

namespace placegraph {

/// What marginalization leaves of the keyframes and landmarks that are gone: one linear residual on
/// the deviations of the retained keyframes from their linearization points,
///
///   r = e + J delta,   delta_k = log(T_lin_k^-1 T_map_cam_k)   (right tangent, stacked)
///   d r / d xi_k = J_k right_jacobian_inverse(delta_k)
struct MarginalPrior {
  std::vector<std::int64_t> keyframes;  ///< ascending; six columns of J each
  std::vector<SE3> T_map_cam_lin;       ///< first estimates: fixed once a keyframe is in the prior
  Eigen::MatrixXd J;                    ///< rank x 6 K
  Eigen::VectorXd e;

  bool empty() const { return keyframes.empty(); }
};

/// The prior as a factor on the blocks T_map_cam of `prior.keyframes`; `prior` must outlive it.
class MarginalPriorFactor final : public ceres::CostFunction {
 public:
  explicit MarginalPriorFactor(const MarginalPrior& prior) : prior_(prior) {
    set_num_residuals(static_cast<int>(prior.J.rows()));
    mutable_parameter_block_sizes()->assign(prior.keyframes.size(), 7);
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const int rows = num_residuals();
    Eigen::Map<Eigen::VectorXd> r(residuals, rows);
    r = prior_.e;
    for (std::size_t k = 0; k < prior_.keyframes.size(); ++k) {
      const auto J_k = prior_.J.middleCols<6>(6 * static_cast<Eigen::Index>(k));
      const Vector6d delta =
          (prior_.T_map_cam_lin[k].inverse() * PoseBlock<SE3>::load(parameters[k])).log();
      r.noalias() += J_k * delta;
      if (!jacobians || !jacobians[k]) continue;
      Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, 7, Eigen::RowMajor>> J(jacobians[k], rows,
                                                                              7);
      J.leftCols<6>().noalias() = J_k * SE3::right_jacobian_inverse(delta);
      J.col(6).setZero();
    }
    return true;
  }

 private:
  const MarginalPrior& prior_;
};

}  // namespace placegraph
