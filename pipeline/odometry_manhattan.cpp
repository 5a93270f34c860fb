#include <placegraph/pipeline/odometry.h>

namespace placegraph {

/// Lines that are followed anyway serve, where there are any.
void Odometry::look_at_directions(const Frame& frame) {
  const auto span = times_.measure("directions");
  std::optional<std::vector<LineSegment>> segments;
  if (lines_) {
    segments.emplace();
    for (const FrameView::Line& line : lines_->view(window_, window_.pose(last_keyframe_)))
      segments->push_back(line.segment);
  }
  manhattan_->observe(last_keyframe_, frame.image, segments, window_);
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
