#pragma once
#include <placegraph/frontend/internal/flow/flow_vector.h>
#include <placegraph/graph/core/options.h>

namespace placegraph {

struct LucasKanadeOptions {
  int window_px = 21;
  int levels = 4;
  int iterations = 30;
  double epsilon_px = 0.01;        ///< a step shorter than this ends the iteration of a level
  double min_eigenvalue = 3e-5;    ///< of the gradient matrix per pixel, grey levels / 255
  double max_return_error_px = 1;  ///< of the way back to the start; 0: it is not walked
  void check() const;
};
void visit(OptionVisitor& field, LucasKanadeOptions& options);

/// Pyramidal Lucas-Kanade (Lucas & Kanade 1981; Bouguet 2000) from one image to the next (CV_8UC1,
/// of one size), one answer for each of `points` (pixels of the first). A window whose gradient
/// matrix has two eigenvalues above the threshold gives its full flow, one with one such eigenvalue
/// its normal flow, anything else nothing, and so does a point that leaves the image or, of full
/// flows, does not come back to its start. Covariances are those of least squares, from the
/// residual's variance, corrected for the correlation that smoothing gives to neighbouring pixels.
/// Windows may reach over the sides of the first image: what lies outside counts as without
/// gradient. Throws ArgumentError.
std::vector<FlowVector> lucas_kanade(const Image& from, const Image& to,
                                     const std::vector<Eigen::Vector2d>& points,
                                     const LucasKanadeOptions& options);

}  // namespace placegraph
