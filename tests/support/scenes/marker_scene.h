#pragma once
#include <placegraph/frontend/markers/marker_dictionary.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/measurements/marker_layout.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/aruco.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace placegraph::test {

/// The picture of a marker as somebody reads it, without white around it, 0 or 255.
inline Image marker_picture(const std::string& dictionary, int id, int cell_px) {
  const MarkerFamily cluster = marker_family(dictionary);
  const cv::aruco::Dictionary codes(cluster.codes, cluster.bits_per_side, cluster.correctable_bits);
  Image picture;
  codes.drawMarker(id, (cluster.bits_per_side + 2) * cell_px, picture, 1);
  return picture;
}

/// How a camera sees a layout of markers and beacons.
struct MarkerScene {
  MarkerLayout layout;
  Camera camera;
  double blur_px = 0.7;    ///< of the lens
  double noise = 2;        ///< grey levels
  double quiet_cells = 1;  ///< white around a marker, in its cells
  double black = 30, white = 210;
  double ground = 120;       ///< where nothing is
  double beacon_grey = 900;  ///< in the middle of a beacon's spot before the sensor saturates
  double beacon_px = 1.6;    ///< spread of its spot
  int samples = 5;           ///< a pixel's side is looked at in so many places

  static Camera usual_camera() {
    Camera camera;
    camera.width = 640;
    camera.height = 480;
    camera.fx = camera.fy = 460;
    camera.cx = 322.3;
    camera.cy = 237.1;
    return camera;
  }

  /// The light that falls on the sensor, by rays through samples of the pixels.
  Image render(const SE3& T_world_cam, Random& random) const {
    Image light(camera.height, camera.width, CV_32FC1, cv::Scalar(ground));
    for (int v = 0; v < light.rows; ++v)
      for (int u = 0; u < light.cols; ++u)  // a ground that is not plain
        light.at<float>(v, u) +=
            static_cast<float>(12 * std::sin(0.031 * u + 0.017 * v) + 9 * std::sin(0.045 * v));
    for (const PlacedMarker& marker : layout.markers)
      paint(marker, marker.T_world_marker.inverse() * T_world_cam, light);
    for (const Eigen::Vector3d& beacon : layout.beacons_world)
      paint_beacon(T_world_cam.inverse() * beacon, light);
    if (blur_px > 0) cv::GaussianBlur(light, light, cv::Size(), blur_px);
    Image grey(light.size(), CV_8UC1);
    for (int v = 0; v < light.rows; ++v)
      for (int u = 0; u < light.cols; ++u)
        grey.at<std::uint8_t>(v, u) = cv::saturate_cast<std::uint8_t>(
            light.at<float>(v, u) + (noise > 0 ? random.normal(0, noise) : 0));
    return grey;
  }

 private:
  void paint(const PlacedMarker& marker, const SE3& T_marker_cam, Image& light) const {
    const Image picture = marker_picture(layout.dictionary, marker.id, 1);
    const double cell = marker.side_m / picture.cols,
                 reach = marker.side_m / 2 + quiet_cells * cell;
    const Eigen::Vector3d camera_position = T_marker_cam.translation();
    if (camera_position.z() <= 0) return;
    double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
    for (const double x : {-reach, reach})
      for (const double y : {-reach, reach}) {
        const auto px = camera.project(T_marker_cam.inverse() * Eigen::Vector3d(x, y, 0));
        if (!px) return;
        left = std::min(left, px->x() - 2);
        right = std::max(right, px->x() + 2);
        top = std::min(top, px->y() - 2);
        bottom = std::max(bottom, px->y() + 2);
      }
    for (int v = std::max(0, static_cast<int>(top)); v <= std::min(bottom, light.rows - 1.0); ++v)
      for (int u = std::max(0, static_cast<int>(left)); u <= std::min(right, light.cols - 1.0); ++u)
        light.at<float>(v, u) = static_cast<float>(
            pixel(picture, cell, reach, T_marker_cam, u, v, light.at<float>(v, u)));
  }
  double pixel(const Image& picture, double cell, double reach, const SE3& T_marker_cam, int u,
               int v, double behind) const {
    const Eigen::Vector3d camera_position = T_marker_cam.translation();
    double sum = 0;
    for (int j = 0; j < samples; ++j)
      for (int i = 0; i < samples; ++i) {
        const auto ray =
            camera.unproject({u + (i + 0.5) / samples - 0.5, v + (j + 0.5) / samples - 0.5});
        const Eigen::Vector3d path =
            T_marker_cam.rotation() * ray.value_or(Eigen::Vector3d::UnitZ());
        const Eigen::Vector3d hit = camera_position - camera_position.z() / path.z() * path;
        const bool sheet = path.z() < 0 && std::max(std::abs(hit.x()), std::abs(hit.y())) <= reach;
        if (!sheet) {
          sum += behind;
          continue;
        }
        const int column = static_cast<int>(std::floor(hit.x() / cell + 0.5 * picture.cols));
        const int row = static_cast<int>(std::floor(0.5 * picture.rows - hit.y() / cell));
        const bool inside = column >= 0 && row >= 0 && column < picture.cols && row < picture.rows;
        sum += !inside || picture.at<std::uint8_t>(row, column) ? white : black;
      }
    return sum / (samples * samples);
  }
  void paint_beacon(const Eigen::Vector3d& beacon_cam, Image& light) const {
    const auto px = camera.project(beacon_cam);
    if (!px || !camera.contains(*px, 1)) return;
    const int reach = static_cast<int>(6 * beacon_px) + 1;
    for (int v = static_cast<int>(px->y()) - reach; v <= px->y() + reach; ++v)
      for (int u = static_cast<int>(px->x()) - reach; u <= px->x() + reach; ++u) {
        if (u < 0 || v < 0 || u >= light.cols || v >= light.rows) continue;
        const double r2 = (Eigen::Vector2d(u, v) - *px).squaredNorm() / (beacon_px * beacon_px);
        light.at<float>(v, u) += static_cast<float>(beacon_grey * std::exp(-0.5 * r2));
      }
  }
};

/// A camera that looks at the origin of the world's x-y plane from `range_m` away, its view tilted
/// by `tilt_rad` from the plane's normal towards `azimuth_rad`, turned by `roll_rad` about the
/// view.
inline SE3 looking_at_origin(double range_m, double tilt_rad, double azimuth_rad, double roll_rad) {
  const SO3 R = SO3::exp({0, 0, azimuth_rad}) * SO3::exp({0, tilt_rad, 0}) *
                SO3::exp({std::numbers::pi, 0, 0}) * SO3::exp({0, 0, roll_rad});
  return {R, Eigen::Vector3d(R * Eigen::Vector3d(0, 0, -range_m))};
}

}  // namespace placegraph::test
