#pragma once
#include <ceres/cost_function.h>
#include <placegraph/backend/factors/variable_manifold.h>
#include <placegraph/graph/core/ids.h>

#include <cstdint>
#include <vector>

namespace placegraph {

/// The prior by marginalized keyframes and landmarks.
/// It is one linear residual of the deviations of the remaining keyframes, planes and Manhattan
/// frames from their linearization points,
///
///   r = e + J delta,   delta_k = x_k [-] x_lin_k   (right tangents, stacked in that order)
///   d r / d xi_k = J_k right_jacobian_inverse(delta_k)
///
/// For a plane the tangent is that of its quaternion, so the Jacobian is that of SO(3).
struct MarginalPrior {
  std::vector<KeyframeId> keyframes;  ///< ascending; six columns of J each
  std::vector<SE3> T_map_cam_lin;     ///< first estimates, fixed once a keyframe is in the prior
  std::vector<PlaneId> planes;        ///< ascending; three columns each, after the keyframes'
  std::vector<Plane3> plane_lin;      ///< first estimates
  std::vector<ManhattanFrameId>
      manhattan_frames;                  ///< ascending; three columns each, after the planes'
  std::vector<SO3> R_map_manhattan_lin;  ///< first estimates
  Eigen::MatrixXd J;                     ///< rank x (6 K + 3 P + 3 W)
  Eigen::VectorXd e;

  bool empty() const { return keyframes.empty() && planes.empty() && manhattan_frames.empty(); }
  auto keyframe_columns(std::size_t k) const {
    return J.middleCols<6>(6 * static_cast<Eigen::Index>(k));
  }
  auto plane_columns(std::size_t k) const {
    return J.middleCols<3>(6 * static_cast<Eigen::Index>(keyframes.size()) +
                           3 * static_cast<Eigen::Index>(k));
  }
  auto manhattan_columns(std::size_t k) const {
    return J.middleCols<3>(6 * static_cast<Eigen::Index>(keyframes.size()) +
                           3 * static_cast<Eigen::Index>(planes.size() + k));
  }
};

/// The prior as a Ceres cost function.
/// Its blocks are T_map_cam of `prior.keyframes`, then those of `prior.planes`, then
/// R_map_manhattan of `prior.manhattan_frames`. `prior` must outlive it.
class MarginalPriorFactor final : public ceres::CostFunction {
 public:
  explicit MarginalPriorFactor(const MarginalPrior& prior) : prior_(prior) {
    set_num_residuals(static_cast<int>(prior.J.rows()));
    mutable_parameter_block_sizes()->assign(prior.keyframes.size(), VariableBlock<SE3>::kSize);
    mutable_parameter_block_sizes()->insert(mutable_parameter_block_sizes()->end(),
                                            prior.planes.size(), VariableBlock<Plane3>::kSize);
    mutable_parameter_block_sizes()->insert(mutable_parameter_block_sizes()->end(),
                                            prior.manhattan_frames.size(),
                                            VariableBlock<SO3>::kSize);
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    Eigen::Map<Eigen::VectorXd> r(residuals, num_residuals());
    r = prior_.e;
    std::size_t block = 0;
    const auto add = [&]<class T, class Tangent>(const T&, const auto& J_k, const Tangent& delta,
                                                 const auto& J_delta) {
      r.noalias() += J_k * delta;
      if (!jacobians || !jacobians[block]) return;
      Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, VariableBlock<T>::kSize, Eigen::RowMajor>> J(
          jacobians[block], num_residuals(), VariableBlock<T>::kSize);
      J.template leftCols<VariableBlock<T>::kDof>().noalias() = J_k * J_delta(delta);
      J.col(VariableBlock<T>::kDof).setZero();
    };
    for (std::size_t k = 0; k < prior_.keyframes.size(); ++k, ++block) {
      const SE3 T_map_cam = VariableBlock<SE3>::load(parameters[block]);
      add(T_map_cam, prior_.keyframe_columns(k),
          VariableBlock<SE3>::minus(T_map_cam, prior_.T_map_cam_lin[k]),
          SE3::right_jacobian_inverse);
    }
    for (std::size_t k = 0; k < prior_.planes.size(); ++k, ++block) {
      const Plane3 plane_map = VariableBlock<Plane3>::load(parameters[block]);
      add(plane_map, prior_.plane_columns(k), plane_map.minus(prior_.plane_lin[k]),
          SO3::right_jacobian_inverse);
    }
    for (std::size_t k = 0; k < prior_.manhattan_frames.size(); ++k, ++block) {
      const SO3 R_map_manhattan = VariableBlock<SO3>::load(parameters[block]);
      add(R_map_manhattan, prior_.manhattan_columns(k),
          VariableBlock<SO3>::minus(R_map_manhattan, prior_.R_map_manhattan_lin[k]),
          SO3::right_jacobian_inverse);
    }
    return true;
  }

 private:
  const MarginalPrior& prior_;
};

}  // namespace placegraph
