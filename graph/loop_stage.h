#pragma once

#include <optional>
#include <string_view>

namespace [[gnu::visibility("default")]] placegraph {

/// The geometric model by which the relative pose of a loop was found.
enum class LoopModel {
  kNone,        ///< no relative pose was computed or found
  kPoints3d2d,  ///< points of known depth in one keyframe, pixels in the other
  kEssential,   ///< pixels in both; a few known depths determine the length of the translation
  kHomography,  ///< pixels in both, for points on one plane
};

/// The name of a model in files: "none", "3d2d", "essential" or "homography".
const char* to_string(LoopModel model);
/// The model with the given name; nothing for any other text.
std::optional<LoopModel> loop_model(std::string_view name);

/// The test that refused a loop candidate, or kAccepted, in the order of the tests.
enum class LoopStage {
  kRetrieval,   ///< the images are not similar enough
  kReach,       ///< by odometry the two keyframes are too far apart for any loop between them
  kGeometry,    ///< no relative pose agrees with the features
  kDrift,       ///< the relative pose differs from odometry by more than the drift of odometry
  kCovariance,  ///< the relative pose contradicts that of the map, given the map's covariance
  kSupport,     ///< no second loop agrees (yet)
  kAccepted,    ///< the loop became a constraint of the map
  kManual,      ///< no test: a person refused the loop in the saved map
};
/// Number of stages that a run can decide: all but kManual.
inline constexpr int kLoopStageCount = static_cast<int>(LoopStage::kAccepted) + 1;

/// The name of a stage in files.
/// In the order of LoopStage: "retrieval", "drift", "geometry", "drift", "covariance", "support",
/// "accepted", "manual". Both tests by odometry are called "drift": kReach is tested before a
/// relative pose is computed, kDrift afterwards.
const char* to_string(LoopStage stage);
/// The stage with the given name; nothing for any other text.
/// `model` distinguishes the two stages with the name "drift": kNone means kReach.
std::optional<LoopStage> loop_stage(std::string_view name, LoopModel model);

}  // namespace placegraph
