#pragma once
#include <placegraph/graph/image/image.h>

#include <Eigen/Core>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Displacement of one point between two images.
struct FlowVector {
  /// What is known of a displacement.
  enum class Kind {
    kNone,    ///< nothing
    kNormal,  ///< `flow` is only the component along the gradient (aperture problem)
    kFull     ///< both components
  };
  Kind kind = Kind::kNone;                         ///< what is known
  Eigen::Vector2d px = Eigen::Vector2d::Zero();    ///< in the first image
  Eigen::Vector2d flow = Eigen::Vector2d::Zero();  ///< [px]
  /// Covariance of `flow` [px^2]. For a normal flow it has the variance of its own direction only.
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
};

/// Image of full vectors, each at the nearest pixel: CV_32FC2 [px], NaN elsewhere.
Image flow_image(const std::vector<FlowVector>& vectors, int width, int height);

/// The points (u, v) of a grid that begins half a step inside the image.
std::vector<Eigen::Vector2d> flow_grid(int width, int height, int step_px);

/// Standard deviation of the pixels' noise [grey levels], at least 0.5.
///
/// From the response to a mask that is zero on every plane of grey values (Immerkaer 1996, "Fast
/// noise variance estimation"), by the lower quartile over a grid, so that edges are ignored. Fine
/// texture counts as noise. CV_8UC1.
double image_noise(const Image& image);

/// Covariance [px^2] of a displacement by least squares over a window.
///
/// Both images have noise of `noise_grey`: 2 noise^2 G^-1, G the sum of the gradients' outer
/// products without the noise's contribution. In a direction without texture the standard deviation
/// is one side of the window.
Eigen::Matrix2d track_covariance(const Image& image, const Eigen::Vector2d& px, int window_px,
                                 double noise_grey);

/// Samples of a dense flow image with their covariances.
///
/// From each cell of `cell_px` pixels a side of a flow image (CV_32FC2, NaN where unknown) it takes
/// the vector nearest to the centre, with a covariance from the grey values around it in the first
/// image (CV_8UC1, of the same size, else ArgumentError). Cells whose gradients do not exceed those
/// of the noise are left out.
std::vector<FlowVector> sampled_flow(const Image& from, const Image& flow, int cell_px);

}  // namespace placegraph
