#pragma once
#include <numbers>

namespace [[gnu::visibility("default")]] placegraph {

/// The size of a degree [rad].
inline constexpr double kRadPerDeg = std::numbers::pi / 180;

/// Degrees as radians.
constexpr double deg_to_rad(double angle_deg) { return angle_deg * std::numbers::pi / 180; }
/// Radians as degrees.
constexpr double rad_to_deg(double angle_rad) { return angle_rad * 180 / std::numbers::pi; }

}  // namespace placegraph
