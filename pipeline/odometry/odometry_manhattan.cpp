#include <placegraph/pipeline/odometry/odometry.h>

#include <Eigen/Cholesky>

namespace placegraph {

/// Lines that are followed anyway serve, where there are any.
void Odometry::look_at_directions(const Frame& frame) {
  const auto span = times_.measure("directions");
  std::optional<std::vector<LineSegment>> segments;
  if (lines_) {
    segments.emplace();
    for (const FrameView::Line& line : lines_->view(window_, window_.pose(last_keyframe_)))
      segments->push_back(line.segment);
    if (segments->empty()) segments.reset();  // none are followed yet
  }
  manhattan_->observe(last_keyframe_, frame.image, segments, window_);
}

/// What a frame that few points pose sees of the worlds.
std::optional<ManhattanCue::Heading> Odometry::heading_of(const Frame& frame, const SE3& T_odom_cam,
                                                          int points) const {
  if (!sees_worlds() || points >= options_.manhattan.few_points) return std::nullopt;
  return manhattan_->heading(frame.image, T_odom_cam.rotation(), window_, last_keyframe_);
}

/// A pose, known by `information` (right tangent), where a heading agrees with it best: the
/// translation follows the turn as far as the points let it.
SE3 Odometry::turned(const SE3& T_odom_cam, const Matrix6d& information,
                     const std::optional<ManhattanCue::Heading>& heading) const {
  const auto R_odom_world = heading ? window_.world(heading->world) : std::nullopt;
  if (!R_odom_world) return T_odom_cam;
  const SO3 R_odom_cam = *R_odom_world * heading->R_cam_world.inverse();
  // The heading's covariance is of R_cam_world's right tangent; that of R_odom_cam is turned.
  const Eigen::Matrix3d R = heading->R_cam_world.matrix();
  const Eigen::Matrix3d weight = R * heading->information * R.transpose();
  Matrix6d H = information;
  H.bottomRightCorner<3, 3>() += weight;
  Vector6d g = Vector6d::Zero();
  g.tail<3>() = weight * (T_odom_cam.rotation().inverse() * R_odom_cam).log();
  const Vector6d step = H.ldlt().solve(g);
  return step.allFinite() ? T_odom_cam.plus(step) : T_odom_cam;
}

/// A world turns the keyframes of the window, and no longer one that has left it: what the oldest
/// was turned by since then is an error that its link to that one has come to have.
void Odometry::widen_last_link(const SE3& T_odom_oldest) {
  const std::int64_t oldest = window_.keyframes().front();
  const auto link = links_.find(oldest - 1);
  const auto before = keyframe_poses_.find(oldest);
  if (link == links_.end() || before == keyframe_poses_.end()) return;
  const Eigen::Vector3d turn =
      (before->second.rotation().inverse() * T_odom_oldest.rotation()).log();
  // (H^-1 + g g^T)^-1 of the rotation (Sherman & Morrison 1950)
  Vector6d g = Vector6d::Zero();
  g.tail<3>() = turn;
  Matrix6d& H = link->second.information;
  const Vector6d Hg = H * g;
  H -= Hg * Hg.transpose() / (1 + g.dot(Hg));
}

}  // namespace placegraph
