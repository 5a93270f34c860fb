#pragma once
#include <placegraph/graph/image/image.h>

#include <Eigen/Core>
#include <vector>

namespace placegraph {

/// What is known of the displacement of one point between two images.
struct FlowVector {
  enum class Kind {
    kNone,    ///< nothing
    kNormal,  ///< only its component along the gradient (aperture problem): `flow` is that one
    kFull
  };
  Kind kind = Kind::kNone;
  Eigen::Vector2d px = Eigen::Vector2d::Zero();    ///< in the first image
  Eigen::Vector2d flow = Eigen::Vector2d::Zero();  ///< [px]
  /// Of `flow` [px^2]. A normal flow has the variance of its own direction in it, and no other.
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
};

/// CV_32FC2 of the given size, NaN but for the full vectors, each at the pixel nearest to it.
Image flow_image(const std::vector<FlowVector>& vectors, int width, int height);

/// The points (u, v) of a grid that begins half a step inside the image.
std::vector<Eigen::Vector2d> flow_grid(int width, int height, int step_px);

/// Sigma of the pixels' noise in grey levels, at least 0.5: from the response to a mask that no
/// plane of grey values answers (Immerkaer 1996, "Fast noise variance estimation"), by the lower
/// quartile over a grid, so that edges do not count. Fine texture counts as noise. CV_8UC1.
double image_noise(const Image& image);

/// Covariance [px^2] of the displacement that least squares over a window find where both images
/// have noise of `noise_grey`: 2 noise^2 G^-1, G the sum of the gradients' outer products without
/// the noise's own share. A window that shows nothing in some direction is sure to one window side.
Eigen::Matrix2d track_covariance(const Image& image, const Eigen::Vector2d& px, int window_px,
                                 double noise_grey);

/// Full vectors of a flow image (CV_32FC2, NaN where nothing is known), of each cell of `cell_px`
/// pixels a side the one nearest to its middle, with the covariance that the grey values around it
/// in the first image (CV_8UC1, of its size, else ArgumentError) give it. Cells whose
/// gradients do not outdo those of the noise are left out.
std::vector<FlowVector> sampled_flow(const Image& from, const Image& flow, int cell_px);

}  // namespace placegraph
