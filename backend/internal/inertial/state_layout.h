#pragma once

namespace placegraph {

/// Where the errors of a body state stand in its covariance (BodyState::covariance), three each.
inline constexpr int kPosition = 0, kVelocity = 3, kAttitude = 6, kGyroBias = 9, kAccelBias = 12;

}  // namespace placegraph
