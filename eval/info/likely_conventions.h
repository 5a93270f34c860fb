#pragma once
#include <placegraph/eval/info/motion_steps.h>

namespace placegraph {

/// Whether the quaternions were read in the order of the file.
/// Evidence is a body that moves along one of its directions in one of the two orders alone, or a
/// path that begins at the identity in one of them alone.
Likelihood likely_quaternions(const PosedFrames& frames);

/// Whether positions may be metres, by the usual speed.
Likelihood likely_length_unit(const PosedFrames& frames, const Spread& speed);

/// Whether stamps may be seconds as read, by their spacing.
Likelihood likely_time_unit(const PosedFrames& frames);

}  // namespace placegraph
