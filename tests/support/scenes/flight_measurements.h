#pragma once
#include <placegraph/graph/core/random.h>
#include <placegraph/io/synthetic/worlds/flight_world.h>
#include <placegraph/pipeline/flight/flight_estimator.h>

#include <functional>
#include <optional>

namespace placegraph::test {

/// What a camera over the hover world sees, measured without an image: points of the floor, corners
/// of markers and beacons where they truly are, with noise.
struct FlightMeasurementsOptions {
  int flow_points = 95;
  double flow_sigma_px = 0.08, corner_sigma_px = 0.1, beacon_sigma_px = 0.1;
};

class FlightMeasurementsSource {
 public:
  FlightMeasurementsSource(const synthetic::Tour& tour, const FlightMeasurementsOptions& options,
                           std::uint64_t seed)
      : setting_(*tour.flight_setting),
        camera_(tour.camera),
        options_(options),
        random_(seed, 71) {}

  /// Flow is that since the image that was looked at before.
  FlightMeasurements observe(std::size_t image, bool markers_visible = true) {
    FlightMeasurements observations;
    observations.stamp_ns = setting_.flight.at_image(image).stamp_ns;
    const SE3 T_world_cam = pose(image);
    if (last_) observations.flow = flow(pose(*last_), T_world_cam);
    last_ = image;
    if (!markers_visible) return observations;
    const SE3 T_cam_world = T_world_cam.inverse();
    for (const PlacedMarker& marker : setting_.layout.markers) {
      MarkerObservation seen;
      seen.id = marker.id;
      seen.contrast = 100;
      bool whole = true;
      const auto corners = marker.corners_marker();
      for (std::size_t i = 0; i < 4 && whole; ++i) {
        const auto px = camera_.project(T_cam_world * (marker.T_world_marker * corners[i]));
        whole = px && camera_.contains(*px, 5);
        if (whole) seen.corners_px[i] = *px + noise(options_.corner_sigma_px);
      }
      seen.covariance *= options_.corner_sigma_px * options_.corner_sigma_px;
      if (whole) observations.markers.push_back(seen);
    }
    for (const Eigen::Vector3d& beacon : setting_.layout.beacons_world) {
      const auto px = camera_.project(T_cam_world * beacon);
      if (!px || !camera_.contains(*px, 5)) continue;
      BeaconObservation seen;
      seen.px = *px + noise(options_.beacon_sigma_px);
      seen.covariance *= options_.beacon_sigma_px * options_.beacon_sigma_px;
      seen.area_px = 50;
      observations.beacons.push_back(seen);
    }
    return observations;
  }

 private:
  SE3 pose(std::size_t image) const {
    return setting_.flight.at_image(image).T_world_body * setting_.T_body_cam;
  }
  Eigen::Vector2d noise(double sigma) {
    const double x = random_.normal(0, sigma);
    return {x, random_.normal(0, sigma)};
  }
  std::vector<FlowVector> flow(const SE3& T_world_1, const SE3& T_world_2) {
    std::vector<FlowVector> vectors;
    for (int i = 0; i < options_.flow_points; ++i) {
      const double u = random_.uniform(5, camera_.width - 6.0);
      const Eigen::Vector2d px(u, random_.uniform(5, camera_.height - 6.0));
      const Eigen::Vector3d ray = T_world_1.rotation() * *camera_.unproject(px);
      const Eigen::Vector3d floor =
          T_world_1.translation() - T_world_1.translation().z() / ray.z() * ray;
      const auto seen = camera_.project(T_world_2.inverse() * floor);
      if (!seen || !camera_.contains(*seen, 3)) continue;
      FlowVector vector;
      vector.kind = FlowVector::Kind::kFull;
      vector.px = px;
      vector.flow = *seen + noise(options_.flow_sigma_px) - px;
      vector.covariance =
          options_.flow_sigma_px * options_.flow_sigma_px * Eigen::Matrix2d::Identity();
      vectors.push_back(vector);
    }
    return vectors;
  }

  synthetic::FlightSetting setting_;
  Camera camera_;
  FlightMeasurementsOptions options_;
  Random random_;
  std::optional<std::size_t> last_;
};

/// Flies a hover world through the pipeline without images. `visible(t)` says when markers are
/// looked for, t seconds after the first image; `dropped(i)` which images never come.
template <class Visible>
std::vector<FlightFrame> fly_without_images(const synthetic::Tour& tour, FlightOptions options,
                                            const FlightMeasurementsOptions& observations,
                                            std::uint64_t seed, const Visible& visible,
                                            const std::function<bool(std::size_t)>& dropped = {}) {
  const synthetic::FlightSetting& setting = *tour.flight_setting;
  const ImuNoise& noise = setting.flight.imu.noise;
  options.filter.gyro_noise = noise.gyro;
  options.filter.accel_noise = noise.accel;
  options.filter.gyro_bias_walk = noise.gyro_bias_walk;
  options.filter.accel_bias_walk = noise.accel_bias_walk;
  FlightEstimator estimator(options, tour.camera, setting.T_body_cam, setting.layout);
  FlightMeasurementsSource source(tour, observations, seed);
  std::vector<FlightFrame> frames;
  std::size_t sample = 0;
  for (std::size_t i = 0; i < setting.flight.images.size(); ++i) {
    for (; sample <= setting.flight.images[i]; ++sample)
      (void)estimator.add(setting.flight.imu.samples[sample]);
    if (dropped && dropped(i)) continue;
    const double t = tour.time_s[i] - tour.time_s[0];
    frames.push_back(estimator.add(source.observe(i, visible(t))));
  }
  return frames;
}

}  // namespace placegraph::test
