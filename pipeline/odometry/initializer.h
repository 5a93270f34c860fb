#pragma once
#include <placegraph/pipeline/odometry/local_mapping.h>

namespace placegraph {

/// Result of processing a frame during initialization.
struct Initialization {
  /// kTracking: the map has begun. kInitializing: another frame is needed. kLost: the first view
  /// has been lost, and the frame cannot replace it.
  TrackingState state = TrackingState::kInitializing;
  Outcome outcome;  ///< reason why the map has not begun, or why the first view was replaced
  std::optional<SE3> T_last_cur;  ///< initial velocity; nothing if the frame is the first
  int inliers = 0;
  std::vector<NewKeyframe> keyframes;
  std::vector<PosedFrame> posed;  ///< frames between the keyframes
  bool is_reference = false;      ///< during initialization: the frame is the first of the views
  SE3 T_odom_reference;           ///< pose of the first view, if `is_reference`
  /// During initialization: rotation since the first view, or, if the frame replaced it, since the
  /// previous first view.
  std::optional<PureRotation> rotation;

  /// Converts the result to an update of the odometry; the pose of a map that has begun is still
  /// missing.
  OdometryUpdate update() const;
  static Initialization pending(Outcome outcome) {
    Initialization result;
    result.outcome = std::move(outcome);
    return result;
  }
};

inline OdometryUpdate Initialization::update() const {
  OdometryUpdate update;
  update.state = state;
  update.outcome = outcome;
  update.inliers = inliers;
  update.new_keyframes = keyframes;
  update.posed_again = posed;
  update.rotation = rotation;
  update.reference = is_reference;
  update.T_odom_cam = T_odom_reference;
  return update;
}

/// Outcome if no measurement makes the scale of the map observable.
inline Outcome no_scale_of_map() {
  return Outcome::failure(Outcome::Code::kDegenerate, "the scale of the map is unobservable");
}

/// Begins a map: adds its first keyframes and landmarks, or nothing.
class Initializer {
 public:
  virtual ~Initializer() = default;
  /// Restarts; the next frame is the first, with pose T_odom_cam.
  virtual void restart(const SE3& T_odom_cam) = 0;
  /// Whether a first view has been taken since the restart.
  virtual bool started() const = 0;
  /// Processes the next frame. `T_odom_cam_known`: its pose, if it was recognized in the map.
  [[nodiscard]] virtual Initialization add(const Frame& frame,
                                           const std::optional<SE3>& T_odom_cam_known,
                                           LocalMap& map, LocalMapping& mapping) = 0;
};

}  // namespace placegraph
