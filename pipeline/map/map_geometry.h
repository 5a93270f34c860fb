#pragma once
#include <placegraph/graph/map.h>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Colour that exports give a landmark whose own is unknown.
inline constexpr std::array<std::uint8_t, 3> kUnknownColour = {128, 128, 128};

/// A keyframe of a map with its pose.
struct PosedKeyframe {
  const Keyframe* keyframe = nullptr;  ///< keyframe of the map, which must outlive this
  SE3 T_map_cam;                       ///< pose of its camera, at the map's scale
};

/// A landmark of a map with its position.
struct PlacedLandmark {
  LandmarkId id;                                    ///< id in the map
  KeyframeId keyframe;                              ///< its anchor keyframe
  Eigen::Vector3d p_map = Eigen::Vector3d::Zero();  ///< position, at the map's scale
  std::optional<std::array<std::uint8_t, 3>> rgb;   ///< red, green, blue; nothing if unknown
  /// Standard deviation of the position in its worst direction, given the poses of the keyframes,
  /// at the map's scale; nothing if the map has no covariance of it.
  std::optional<double> sigma;
};

/// Keyframes and landmarks of components of a map, each in the frame of its component.
struct MapGeometry {
  std::vector<PosedKeyframe> keyframes;   ///< by ascending id
  std::vector<PlacedLandmark> landmarks;  ///< in the order of the map
};

/// The geometry of the component with this MapComponent::number, of all of them with nothing.
/// Keyframes without a place, and landmarks without a keyframe, are left out.
MapGeometry geometry_of(const Map& map, std::optional<int> component);

}  // namespace placegraph
