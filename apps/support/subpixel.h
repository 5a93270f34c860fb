#pragma once
#include <Eigen/Core>
#include <opencv2/core.hpp>

namespace placegraph::apps {

/// The `shift` of OpenCV's drawing functions for points and radii in sixteenths of a pixel.
inline constexpr int kShift = 4;

/// A point [px] in sixteenths of a pixel.
inline cv::Point sixteenths(const Eigen::Vector2d& px) {
  return {cvRound(px.x() * (1 << kShift)), cvRound(px.y() * (1 << kShift))};
}

}  // namespace placegraph::apps
