#pragma once

#include <optional>
#include <string_view>

namespace [[gnu::visibility("default")]] placegraph {

/// What the relative pose of a loop was found by.
enum class LoopModel {
  kNone,        ///< it was not looked for, or not found
  kPoints3d2d,  ///< points of known depth in the one view, pixels in the other
  kEssential,   ///< pixels in both, and few depths for the length
  kHomography,  ///< the same where what they see is a plane
};

/// "none", "3d2d", "essential", "homography".
const char* to_string(LoopModel model);
std::optional<LoopModel> loop_model(std::string_view name);

/// How far a loop candidate came: the test that refused it, or kAccepted. In the order of the
/// tests.
enum class LoopStage {
  kRetrieval,   ///< the views are not similar enough
  kReach,       ///< by odometry the two views are too far apart for any loop between them
  kGeometry,    ///< no relative pose that the features agree with
  kDrift,       ///< odometry cannot have drifted to the relative pose that was found
  kCovariance,  ///< the map is too sure of another relative pose
  kSupport,     ///< no second loop agrees (yet)
  kAccepted,
};
inline constexpr int kLoopStageCount = static_cast<int>(LoopStage::kAccepted) + 1;

/// As files have it: "retrieval", "drift", "geometry", "drift", "covariance", "support",
/// "accepted". Both tests by odometry are called "drift": kReach is judged before a relative pose
/// is sought and kDrift afterwards.
const char* to_string(LoopStage stage);
/// The stage of a loop that was found by `model`, which tells the two that are called "drift"
/// apart; nothing for an unknown name.
std::optional<LoopStage> loop_stage(std::string_view name, LoopModel model);

}  // namespace placegraph
