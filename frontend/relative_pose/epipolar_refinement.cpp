#include <placegraph/frontend/relative_pose/epipolar_error.h>
#include <placegraph/frontend/relative_pose/epipolar_refinement.h>

#include <Eigen/Dense>
#include <cmath>

namespace placegraph {
namespace {

using Eigen::Vector3d;

SE3 unit_length(const SE3& T) {
  return SE3(T.rotation(), T.translation() / T.translation().norm());
}

}  // namespace

SE3 refine_epipolar(const Camera& camera, const std::vector<Vector3d>& x_ref,
                    const std::vector<Vector3d>& x_cur, const std::vector<int>& indices,
                    const SE3& T_ref_cur_start, const EpipolarRefinement& how,
                    Matrix6d* information, const MotionKnowledge& knowledge) {
  SE3 T = unit_length(T_ref_cur_start);
  for (int iteration = 0; iteration < how.iterations; ++iteration) {
    const EpipolarError error(camera, T);
    Matrix6d H = Matrix6d::Zero();
    Vector6d g = Vector6d::Zero();
    Eigen::Matrix<double, 1, 6> J;
    for (int i : indices) {
      const double r = error(x_ref[i], x_cur[i], &J);
      if (!J.allFinite() || !std::isfinite(r)) continue;
      const double weight = (std::abs(r) > how.huber_px ? how.huber_px / std::abs(r) : 1) /
                            (how.sigma_px * how.sigma_px);
      H.noalias() += weight * J.transpose() * J;
      g.noalias() += weight * r * J.transpose();
    }
    if (knowledge) knowledge(T, H, g);
    if (information) *information = H;
    // The length of the translation is unobservable and constrained.
    const Vector3d along = T.rotation().matrix().transpose() * T.translation();
    Matrix6d held = H;
    held.topLeftCorner<3, 3>() += H.trace() * along * along.transpose();
    const Vector6d step = -(held + 1e-12 * H.trace() * Matrix6d::Identity()).ldlt().solve(g);
    if (!step.allFinite()) break;
    T = unit_length(T.plus(step));
    if (step.norm() < 1e-9) break;
  }
  return T;
}

double epipolar_rmse_px(const Camera& camera, const std::vector<Vector3d>& x_ref,
                        const std::vector<Vector3d>& x_cur, const std::vector<int>& indices,
                        const SE3& T_ref_cur) {
  const EpipolarError error(camera, T_ref_cur);
  double sum = 0;
  for (int i : indices) sum += std::pow(error(x_ref[i], x_cur[i]), 2);
  return indices.empty() ? 0 : std::sqrt(sum / static_cast<double>(indices.size()));
}

}  // namespace placegraph
