#pragma once
#include <placegraph/eval/edges/truth_noise.h>
#include <placegraph/eval/edges/truth_steps.h>

namespace placegraph {

/// Sets `noise.direction` and its axes if the trajectory is that of a wheeled vehicle: if it moves
/// along one direction of its body, for 20 m or more.
///
/// The direction of motion of a camera `b` ahead of the axle that does not steer is
/// a + b * turn / length of each step; both constants are fitted robustly, and what is left, beyond
/// the white noise of `noise`, is the noise.
void estimate_direction_noise(const TruthSteps& truth, TruthNoise& noise);

}  // namespace placegraph
