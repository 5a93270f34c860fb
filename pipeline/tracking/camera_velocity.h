#pragma once
#include <placegraph/graph/geometry/se3.h>

#include <optional>

namespace placegraph {

/// Velocity of the camera from the motions between its frames: a twist [m/s, rad/s] in the right
/// tangent of the camera's pose. That of a motion is the velocity in the middle of its interval;
/// between and after the middles it changes linearly. A velocity that changes much from one
/// interval to the next is uncertain, and is therefore reduced to what can be expected.
class CameraVelocity {
 public:
  void update(const SE3& T_last_cur, double interval_s) {
    if (!(interval_s > 0)) return;
    before_ = last_;
    last_ = Mean{T_last_cur.log() / interval_s, interval_s};
  }
  void reset() { last_ = before_ = std::nullopt; }
  /// Whether the frames are dense enough: the velocity of a hand changes within a tenth of a second.
  bool known() const { return last_ && last_->interval_s < kLongest_s; }

  /// Velocity `later_s` after the last frame; zero while no motion is known.
  Vector6d at(double later_s = 0) const {
    if (!last_) return Vector6d::Zero();
    if (!before_) return last_->twist;
    const double between_s = (last_->interval_s + before_->interval_s) / 2;
    const Vector6d change = last_->twist - before_->twist;
    const double speed2 = last_->twist.tail<3>().squaredNorm();
    constexpr double kErrorOfChange = 0.5;  // variance of the velocity, as a share of the change's
    const double error2 = kErrorOfChange * change.tail<3>().squaredNorm();
    const double certain = speed2 > 0 ? speed2 / (speed2 + error2) : 1;
    return certain * (last_->twist + (last_->interval_s / 2 + later_s) / between_s * change);
  }

 private:
  struct Mean {
    Vector6d twist;
    double interval_s;
  };
  static constexpr double kLongest_s = 0.07;

  std::optional<Mean> last_, before_;
};

}  // namespace placegraph
