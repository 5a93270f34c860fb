#include <placegraph/frontend/lines/line_depth.h>
#include <placegraph/frontend/lines/line_stereo.h>
#include <placegraph/frontend/lines/line_triangulation.h>
#include <placegraph/pipeline/lines/line_second_camera.h>
#include <placegraph/pipeline/lines/line_tracks.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

using SecondCamera = LineObservation::SecondCamera;

/// Column at which the line through two pixels crosses a row; the line must not be parallel to the
/// rows.
double column_at(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double row) {
  return a.x() + (row - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
}

/// Standard deviation of the depth of the line at a pixel, from the covariance of the line.
double depth_sigma(const Camera& camera, const SE3& T_ref_cam, const TriangulatedLine& line,
                   const Eigen::Vector2d& px, double depth) {
  // Step of the difference quotient: chosen, well above rounding.
  constexpr double kStep = 1e-6;
  Eigen::Vector4d J;
  for (int k = 0; k < 4; ++k) {
    const auto moved =
        depth_on_line(camera, T_ref_cam, line.line_ref.plus(kStep * Eigen::Vector4d::Unit(k)), px);
    J[k] = moved ? (*moved - depth) / kStep : 0;
  }
  return std::sqrt(std::max(0.0, J.dot(line.covariance * J)));
}

}  // namespace

SecondCamera corrected(SecondCamera second, const Camera& camera, const Eigen::Vector2d& left_a,
                       const Eigen::Vector2d& left_b, const RectificationError& error) {
  for (Eigen::Vector2d* px : {&second.start_px, &second.end_px}) {
    const Eigen::Vector2d left((column_at(left_a, left_b, px->y()) - camera.cx) / camera.fx,
                               (px->y() - camera.cy) / camera.fy);
    px->x() += error.at(left);
  }
  return second;
}

std::vector<std::optional<SecondCamera>> second_cameras(const Frame& frame,
                                                        const std::vector<LineSegment>& segments,
                                                        const Calibration& calibration,
                                                        const RectificationError& rectification,
                                                        const StereoMatcherOptions& stereo,
                                                        const LineCueOptions& options) {
  std::vector<std::optional<SecondCamera>> result(segments.size());
  if (calibration.baseline_m > 0 && !frame.right.empty()) {
    const auto right =
        match_stereo_segments(frame.image, frame.right, segments, stereo, options.stereo);
    for (std::size_t i = 0; i < right.size(); ++i) {
      if (!right[i]) continue;
      const auto seen = right[i]->line.carriers(kSigmaFloor_px);
      result[i] = corrected(
          {Eigen::Vector3d(calibration.baseline_m, 0, 0), seen.first, seen.second, seen.sigma_px},
          calibration.camera, segments[i].start, segments[i].end, rectification);
    }
  } else if (calibration.depth && !frame.depth.empty()) {
    const auto depths =
        lookup_depth_along(frame.depth, calibration.camera, *calibration.depth, segments);
    for (std::size_t i = 0; i < depths.size(); ++i) {
      if (!depths[i]) continue;
      const VirtualCamera virtual_camera =
          virtual_camera_from_depth(calibration.camera, segments[i], *depths[i]);
      result[i] = {virtual_camera.second_in_cam, virtual_camera.seen.first,
                   virtual_camera.seen.second,
                   std::hypot(virtual_camera.seen.sigma_px, kSigmaFloor_px)};
    }
  }
  return result;
}

std::optional<DisparitySample> disparity_of_line(const SlidingWindow& window, LineId line,
                                                 const Calibration& calibration,
                                                 const RectificationError& rectification,
                                                 const LineTriangulationOptions& options) {
  const Camera& camera = calibration.camera;
  const auto& observations = window.line_observations(line);
  const LineObservation& newest = observations.back();
  if (!newest.second) return std::nullopt;
  std::vector<LineMeasurement> views;
  for (const LineObservation& o : observations)
    views.push_back({window.pose(o.keyframe), {o.start_px, o.end_px, o.sigma_px}});
  const auto place = triangulate_line(camera, views, options);
  const Eigen::Vector2d px = 0.5 * (newest.start_px + newest.end_px);
  const SE3 T_odom_cam = window.pose(newest.keyframe);
  const auto z = place.outcome ? depth_on_line(camera, T_odom_cam, place.line_ref, px)
                               : std::optional<double>();
  if (!z || !(*z > 0)) return std::nullopt;
  const double fb = camera.fx * calibration.baseline_m;
  const double sigma_motion = fb / (*z * *z) * depth_sigma(camera, T_odom_cam, place, px, *z);
  const Eigen::Vector2d along = (newest.end_px - newest.start_px).normalized();
  const double sigma = std::hypot(newest.sigma_px, newest.second->sigma_px) / std::abs(along.y());
  if (!(sigma_motion < 2 * sigma)) return std::nullopt;
  const Eigen::Vector2d ray((px.x() - camera.cx) / camera.fx, (px.y() - camera.cy) / camera.fy);
  const double disparity =
      px.x() - column_at(newest.second->start_px, newest.second->end_px, px.y());
  return DisparitySample{ray, disparity + rectification.at(ray), fb / *z,
                         std::hypot(sigma, sigma_motion)};
}

}  // namespace placegraph
