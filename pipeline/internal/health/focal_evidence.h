#pragma once
#include <Eigen/Core>

namespace placegraph {

struct WindowState;

/// Evidence of a wrong focal length by bundle adjustment over a window.
/// The parameters are the relative error s of both focal lengths and a radial distortion k1, which
/// has a similar effect at the border of the images:
///
///   px = c + f (1 + s) (1 + k1 r^2) [X/Z, Y/Z],   r^2 = (X^2 + Y^2) / Z^2
///   cost(q) = cost(0) + 2 gradient^T q + q^T information q,   q = [s, k1]
///
/// with free poses and points and without the window's prior, to second order. Windows that share
/// no observation are independent of each other.
struct FocalEvidence {
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
};

/// Evaluates the evidence of the points that are seen from at least three keyframes, at the
/// window's estimate. `depths_measured`: the inverse depths do not depend on the focal length, as
/// those of a depth camera; otherwise, as those from disparities, they are left out.
FocalEvidence focal_evidence(const WindowState& state, bool depths_measured);

}  // namespace placegraph
