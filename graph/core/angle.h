#pragma once
#include <numbers>

namespace placegraph {

inline constexpr double kRadPerDeg = std::numbers::pi / 180;

constexpr double deg_to_rad(double angle_deg) { return angle_deg * std::numbers::pi / 180; }
constexpr double rad_to_deg(double angle_rad) { return angle_rad * 180 / std::numbers::pi; }

}  // namespace placegraph
