#pragma once
#include <placegraph/graph/core/image.h>

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

}  // namespace placegraph
