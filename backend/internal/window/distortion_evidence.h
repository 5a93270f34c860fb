#pragma once

namespace placegraph {

struct WindowState;

/// What bundle adjustment over a window says of a lens that should show no distortion: the sum of
/// its squared residuals, poses and points free and no prior, is to second order
///
///   cost(k1) = cost(0) + 2 gradient k1 + information k1^2
///   px = c + f (1 + k1 r^2) [X/Z, Y/Z],   r^2 = (X^2 + Y^2) / Z^2
///
/// Windows that share no observation are independent of each other.
struct DistortionEvidence {
  double gradient = 0;
  double information = 0;
  int residuals = 0;  ///< of points seen from three keyframes at least, two per pixel
};

/// What the points of the window, at its estimate and without its prior, say of the lens.
DistortionEvidence lens_evidence(const WindowState& state);

}  // namespace placegraph
