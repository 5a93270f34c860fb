#include <placegraph/backend/inertial/state_layout.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/flight/flight_run.h>
#include <placegraph/pipeline/flight/marker_map.h>
#include <placegraph/pipeline/flight/marker_mapping.h>

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace placegraph {
namespace {

using Eigen::Matrix3d;

Matrix3d block(const BodyState& state, int part) {
  return state.covariance.block<3, 3>(part, part);
}

/// Projection of a symmetric matrix to the positive semi-definite ones.
Matrix3d positive_part(const Matrix3d& symmetric) {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> eigen(symmetric);
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).asDiagonal() *
         eigen.eigenvectors().transpose();
}

/// Covariance of the body's motion from one image to the next, right tangent.
Matrix6d step_covariance(const BodyState& before, const FlightFrame& frame, const SE3& T_body_cam,
                         const FlightOptions& options) {
  const BodyState& now = frame.state;
  const double dt = 1e-9 * static_cast<double>(now.stamp_ns - before.stamp_ns);
  const Matrix3d R_world_cam = (before.T_world_body * T_body_cam).rotation().matrix();
  Matrix3d translation_covariance = dt * dt * block(now, kVelocity);
  if (frame.flow && frame.flow_measurement) {
    const double height = (before.T_world_body * T_body_cam).translation().z() - options.floor_z_m;
    translation_covariance = height * height * R_world_cam * frame.flow_measurement->covariance *
                             R_world_cam.transpose();
  }
  const double gyro = options.filter.gyro_noise;
  const Matrix3d rotation_covariance =
      gyro * gyro * dt * Matrix3d::Identity() + dt * dt * block(now, kGyroBias);
  // A correction of the filter is a jump; its covariance is the reduction of the uncertainty.
  const Matrix3d R_world_body = now.T_world_body.rotation().matrix();
  const Matrix3d jump =
      positive_part(block(before, kPosition) + translation_covariance - block(now, kPosition));
  Matrix6d covariance = Matrix6d::Zero();
  covariance.topLeftCorner<3, 3>() =
      R_world_body.transpose() * (translation_covariance + jump) * R_world_body;
  covariance.bottomRightCorner<3, 3>() =
      rotation_covariance +
      positive_part(block(before, kAttitude) + rotation_covariance - block(now, kAttitude));
  return covariance;
}

}  // namespace

MarkerMap map_flight_markers(const Dataset& images, const FlightRun& run, const SE3& T_body_cam,
                             const MarkerLayout& layout, const FlightOptions& options) {
  options.check();
  require(run.frames.size() == images.size(), "map_flight_markers: one frame per image is needed");
  const MarkerDetector detector(options.marker_sensor.detector, layout.dictionary);
  const Matrix6d J_cam_body = T_body_cam.inverse().adjoint();
  std::vector<MarkerFrame> frames;
  // Covariance of the motion since the last frame in `frames`, body.
  Matrix6d since = Matrix6d::Zero();
  std::int64_t last_ns = 0;
  const BodyState* before = nullptr;
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    const FlightFrame& frame = run.frames[i];
    if (!frame.outcome) continue;
    if (before) since += step_covariance(*before, frame, T_body_cam, options);
    before = &frame.state;
    const double waited_s = 1e-9 * static_cast<double>(frame.stamp_ns - last_ns);
    if (!frames.empty() && waited_s < options.map_interval_s) continue;
    MarkerFrame observed;
    observed.T_odom_cam = frame.state.T_world_body * T_body_cam;
    observed.step_covariance = J_cam_body * since * J_cam_body.transpose();
    observed.markers = detector.detect(images.frame(i, Sensor::kMono).image);
    frames.push_back(std::move(observed));
    since.setZero();
    last_ns = frame.stamp_ns;
  }
  return map_markers(frames, layout, layout.unplaced_sides_m,
                     images.calibration(Sensor::kMono).camera, options.map);
}

}  // namespace placegraph
