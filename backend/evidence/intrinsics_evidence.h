#pragma once
#include <Eigen/Core>

namespace placegraph {

struct WindowState;

/// Evidence of wrong intrinsics by bundle adjustment over a window. The parameters q are errors of
/// the stated ones; x = X/Z and y = Y/Z of a point in the camera, r^2 = x^2 + y^2:
///
///   u = cx + fx (1 + s + a/2) (c + (1 + k1 r^2) x)
///   v = cy + fy (1 + s - a/2) (d + (1 + k1 r^2) y)
///   measured depth = Z + o
///   cost(q) = cost(0) + 2 gradient^T q + q^T information q
///
/// with free poses and points and without the window's prior, to second order. Windows that share
/// no observation are independent of each other.
struct IntrinsicsEvidence {
  enum Parameter : Eigen::Index {
    kFocal,        ///< s: relative error of both focal lengths
    kAspect,       ///< a: relative error of fx / fy
    kPrincipalX,   ///< c: error of cx in units of fx
    kPrincipalY,   ///< d: error of cy in units of fy
    kRadial,       ///< k1: radial distortion that is not removed
    kDepthOffset,  ///< o: offset of a depth camera [m]
    kParameters
  };
  using Vector = Eigen::Matrix<double, kParameters, 1>;
  using Matrix = Eigen::Matrix<double, kParameters, kParameters>;

  Vector gradient = Vector::Zero();
  Matrix information = Matrix::Zero();
  int residuals = 0;  ///< residuals of points seen from at least three keyframes, two per pixel
};

/// Evaluates the evidence of the points that are seen from at least three keyframes, at the
/// window's estimate. `depths_measured`: the inverse depths are those of a depth camera, which do
/// not depend on the intrinsics; otherwise they come from disparities, in proportion to 1 / fx.
IntrinsicsEvidence intrinsics_evidence(const WindowState& state, bool depths_measured);

}  // namespace placegraph
