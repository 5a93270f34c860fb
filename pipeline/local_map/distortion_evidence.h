#pragma once

namespace placegraph {

struct WindowState;

/// Evidence of residual lens distortion by bundle adjustment over a window.
/// The sum of the squared residuals with free poses and points and without prior is to second order
///
///   cost(k1) = cost(0) + 2 gradient k1 + information k1^2
///   px = c + f (1 + k1 r^2) [X/Z, Y/Z],   r^2 = (X^2 + Y^2) / Z^2
///
/// Windows that share no observation are independent of each other.
struct DistortionEvidence {
  double gradient = 0;
  double information = 0;
  int residuals = 0;  ///< residuals of points seen from at least three keyframes, two per pixel
};

/// Evaluates the evidence of the window's points at its estimate, without its prior: that of
/// intrinsics_evidence if all intrinsics but k1 are as stated. Inverse depths count as measured.
DistortionEvidence lens_evidence(const WindowState& state);

}  // namespace placegraph
