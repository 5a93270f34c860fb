#pragma once

namespace placegraph {

/// First row of each error (of three) in the covariance of a body state (BodyState::covariance).
inline constexpr int kPosition = 0, kVelocity = 3, kAttitude = 6, kGyroBias = 9, kAccelBias = 12;

}  // namespace placegraph
