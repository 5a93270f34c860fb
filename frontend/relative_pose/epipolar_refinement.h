#pragma once
#include <placegraph/graph/geometry/camera.h>

#include <functional>
#include <vector>

namespace placegraph {

/// Prior of the motion: adds to the normal equations H step = -g at `T_ref_cur`.
///
/// In the right tangent, with errors in units of their standard deviations.
using MotionKnowledge = std::function<void(const SE3& T_ref_cur, Matrix6d& H, Vector6d& g)>;

/// Parameters of the epipolar refinement.
struct EpipolarRefinement {
  double huber_px = 0.5;  ///< width of the Huber kernel
  double sigma_px = 1;    ///< standard deviation of an epipolar error, used for `information`
  int iterations = 6;     ///< number of Gauss-Newton iterations
};

/// Refines T_ref_cur, |t| = 1, by Gauss-Newton on Huber-weighted Sampson errors (EpipolarError).
///
/// Uses the rays `indices`, z = 1. `information`, if given, receives that of the returned pose in
/// the right tangent; it is zero along the translation.
SE3 refine_epipolar(const Camera& camera, const std::vector<Eigen::Vector3d>& x_ref,
                    const std::vector<Eigen::Vector3d>& x_cur, const std::vector<int>& indices,
                    const SE3& T_ref_cur_start, const EpipolarRefinement& how,
                    Matrix6d* information = nullptr, const MotionKnowledge& knowledge = {});

/// Root mean square of the Sampson errors of the rays `indices` [px].
double epipolar_rmse_px(const Camera& camera, const std::vector<Eigen::Vector3d>& x_ref,
                        const std::vector<Eigen::Vector3d>& x_cur, const std::vector<int>& indices,
                        const SE3& T_ref_cur);

}  // namespace placegraph
