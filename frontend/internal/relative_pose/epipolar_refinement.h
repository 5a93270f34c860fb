#pragma once
#include <placegraph/graph/geometry/camera.h>

#include <functional>
#include <vector>

namespace placegraph {

/// What else is known of the motion: adds to the normal equations H step = -g at `T_ref_cur`, right
/// tangent, errors in units of their deviations.
using MotionKnowledge = std::function<void(const SE3& T_ref_cur, Matrix6d& H, Vector6d& g)>;

struct EpipolarRefinement {
  double huber_px = 0.5;  ///< errors beyond this weigh less
  double sigma_px = 1;    ///< of an epipolar error: what `information` is in units of
  int iterations = 6;
};

/// Gauss-Newton over T_ref_cur, |t| = 1, on the Huber-weighted Sampson errors (EpipolarError) of
/// the rays `indices`, z = 1. `information`, if given, receives that of the pose returned, right
/// tangent; it is zero along the translation.
SE3 refine_epipolar(const Camera& camera, const std::vector<Eigen::Vector3d>& x_ref,
                    const std::vector<Eigen::Vector3d>& x_cur, const std::vector<int>& indices,
                    const SE3& T_ref_cur_start, const EpipolarRefinement& how,
                    Matrix6d* information = nullptr, const MotionKnowledge& knowledge = {});

/// Root mean square of the Sampson errors of the rays `indices` [px].
double epipolar_rmse_px(const Camera& camera, const std::vector<Eigen::Vector3d>& x_ref,
                        const std::vector<Eigen::Vector3d>& x_cur, const std::vector<int>& indices,
                        const SE3& T_ref_cur);

}  // namespace placegraph
