#pragma once
#include <placegraph/pipeline/internal/odometry/local_mapping.h>

namespace placegraph {

/// What a frame did for the beginning of a map.
struct Initialization {
  /// kTracking: the map has begun. kInitializing: another frame is needed. kLost: what was waited
  /// for has been lost, and the frame is nothing to begin with either.
  TrackingState state = TrackingState::kInitializing;
  Outcome outcome;                ///< why not, or why with another first view
  std::optional<SE3> T_last_cur;  ///< velocity to go on with; nothing if the frame is the first
  int inliers = 0;
  std::vector<NewKeyframe> keyframes;
  std::vector<PosedFrame> posed;  ///< frames between them
  bool is_reference = false;      ///< while it waits: the frame is the first of the views ...
  SE3 T_odom_reference;           ///< ... and stands here
  /// While it waits: rotation since the first view, or, if the frame has taken its place, since the
  /// one before it.
  std::optional<PureRotation> rotation;

  /// The same as an update of the odometry; the pose of a map that has begun is still missing.
  OdometryUpdate update() const;
  static Initialization waiting(Outcome outcome) {
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

/// What a motion without a length leaves open.
inline Outcome no_scale_of_map() {
  return Outcome::failure(Outcome::Code::kDegenerate, "nothing gives the map's unit");
}

/// Begins a map: adds its first keyframes and landmarks, or nothing.
class Initializer {
 public:
  virtual ~Initializer() = default;
  /// The next frame is the first, and stands at T_odom_cam.
  virtual void restart(const SE3& T_odom_cam) = 0;
  /// Whether a first view has been taken since.
  virtual bool started() const = 0;
  /// `T_odom_cam_known`: where the frame stands, if it was recognized in the map.
  [[nodiscard]] virtual Initialization add(const Frame& frame,
                                           const std::optional<SE3>& T_odom_cam_known,
                                           LocalMap& map, LocalMapping& mapping) = 0;
};

}  // namespace placegraph
