#include "apps/image/draw_markers.h"

#include <opencv2/imgproc.hpp>

#include "apps/support/subpixel.h"

namespace placegraph::apps {

Image draw_markers(const Image& grey, const std::vector<DrawnMarker>& markers,
                   const Camera& camera) {
  Image drawing;
  cv::cvtColor(grey, drawing, cv::COLOR_GRAY2BGR);
  const cv::Scalar outline(0, 200, 255), axes[3] = {{0, 0, 255}, {0, 200, 0}, {255, 80, 0}};
  for (const DrawnMarker& marker : markers) {
    const SquareCorners& corners = marker.observation.corners_px;
    for (int k = 0; k < 4; ++k)
      cv::line(drawing, sixteenths(corners[k]), sixteenths(corners[(k + 1) % 4]), outline, 1,
               cv::LINE_AA, kShift);
    cv::circle(drawing, sixteenths(corners[0]), 3 << kShift, outline, 1, cv::LINE_AA, kShift);
    if (marker.T_cam_marker) {
      const auto origin = camera.project(marker.T_cam_marker->translation());
      for (int axis = 0; origin && axis < 3; ++axis) {
        const auto tip =
            camera.project(*marker.T_cam_marker *
                           Eigen::Vector3d(marker.side_m / 2 * Eigen::Vector3d::Unit(axis)));
        if (tip)
          cv::line(drawing, sixteenths(*origin), sixteenths(*tip), axes[axis], 2, cv::LINE_AA,
                   kShift);
      }
    }
    const Eigen::Vector2d middle = (corners[0] + corners[1] + corners[2] + corners[3]) / 4;
    cv::putText(drawing, std::to_string(marker.observation.id),
                {cvRound(middle.x()) + 4, cvRound(middle.y()) - 4}, cv::FONT_HERSHEY_SIMPLEX, 0.5,
                outline, 1, cv::LINE_AA);
  }
  return drawing;
}

}  // namespace placegraph::apps
