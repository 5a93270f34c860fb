#pragma once
#include <optional>
#include <string_view>

namespace placegraph {

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

}  // namespace placegraph
