#include <placegraph/pipeline/slam_impl.h>

#include <Eigen/Cholesky>

namespace placegraph {

SE3 Slam::Impl::T_map_located(const Loop& located) const {
  return rigid_part(mapper.S_map_keyframe(located.match) * Sim3(located.T_match_query));
}

/// Where a frame is by other sensors since the last keyframe, if both are in metres.
std::optional<Loop> Slam::Impl::carried(const Frame& frame) const {
  if (!motion || last_keyframe < 0 || mapper.units_differ(last_keyframe, last_keyframe))
    return std::nullopt;
  const auto since = motion->between(stamp_of_keyframe.at(last_keyframe), frame.stamp_ns);
  if (!since) return std::nullopt;
  Loop loop{-1, last_keyframe, since->T_a_b};
  loop.information.topLeftCorner<6, 6>() = since->covariance.ldlt().solve(Matrix6d::Identity());
  return loop;
}

/// Where a single eye that has only turned is since the last keyframe, or since it was last placed.
std::optional<Loop> Slam::Impl::turned(const OdometryUpdate& update) const {
  if (!update.rotation || last_keyframe < 0) return std::nullopt;
  Loop loop;
  loop.query = -1;
  loop.match = last_keyframe;
  if (bridge) loop = *bridge;
  Matrix6d covariance = Matrix6d::Zero();
  if (bridge) {
    const Matrix6d back = SE3(update.rotation->R_before_cam.inverse(), {0, 0, 0}).adjoint();
    const Matrix6d before = bridge->information.topLeftCorner<6, 6>();
    covariance = back * before.ldlt().solve(Matrix6d::Identity()) * back.transpose();
  }
  // Way that moves points by no more than what passes for a rotation.
  const double sigma_m =
      options.odometry.turn.threshold_px / calibration.camera.fx * odometry.map().median_depth();
  covariance.topLeftCorner<3, 3>().diagonal().array() += sigma_m * sigma_m;
  covariance.bottomRightCorner<3, 3>() += update.rotation->covariance;
  loop.T_match_query = loop.T_match_query * SE3(update.rotation->R_before_cam, {0, 0, 0});
  loop.information.setZero();
  loop.information.topLeftCorner<6, 6>() = covariance.ldlt().solve(Matrix6d::Identity());
  return loop;
}

void Slam::Impl::recover(const Frame& frame, std::optional<Loop> located, OdometryUpdate& update) {
  ++lost_in_a_row;
  if (!located) located = closer.relocalize(frame);
  if (located) {
    log(log_sink, LogLevel::kInfo, "frame {} relocalized at frame {}", frame.id,
        frame_of_keyframe.at(located->match));
    // The new run begins here; its odometry frame is the map frame of this moment.
    bridge = located;
    const SE3 T_map_frame = T_map_located(*located);
    odometry.restart(T_map_frame, true);
    update = odometry.add_frame(frame, T_map_frame);
    return;
  }
  if (!bridge && update.state == TrackingState::kLost && (bridge = turned(update))) {
    log(log_sink, LogLevel::kInfo, "frame {}: a turn on the spot", frame.id);
    const double unit = mapper.S_map_keyframe(bridge->match).scale();
    odometry.restart(T_map_located(*bridge), false, unit * odometry.map().median_depth());
    update = odometry.add_frame(frame);
    return;
  }
  bridge.reset();
  if (lost_in_a_row == options.max_lost_frames && (bridge = carried(frame))) {
    log(log_sink, LogLevel::kInfo, "frame {}: carried on by measured motion", frame.id);
    odometry.restart(T_map_located(*bridge), true);
    update = odometry.add_frame(frame, T_map_located(*bridge));
    if (!odometry.started()) bridge.reset();
    return;
  }
  if (lost_in_a_row == options.max_lost_frames) {
    log(log_sink, LogLevel::kInfo, "frame {}: a new component of the map begins", frame.id);
    odometry.restart(T_map_last);
    update = odometry.add_frame(frame);
  }
}

}  // namespace placegraph
