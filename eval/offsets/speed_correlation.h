#pragma once
#include <placegraph/eval/offsets/posed_path.h>

namespace placegraph {

/// How far one motion follows another in time, by their speeds.
struct SpeedShift {
  double shift_s = 0;      ///< added to the estimate's times; 0 where the speeds show none
  double correlation = 0;  ///< mean of those of speed and angular speed, at that shift
};

/// The shift at which speed and angular speed of two paths correlate best.
///
/// Neither depends on the frames of world and body, nor the correlation on the scale, so that
/// nothing else needs to be known (Furgale et al. 2013 begin likewise). Zero unless the
/// correlation is clear and clearly better than at zero. Only up to `most_s` either way.
SpeedShift speed_shift(const PosedPath& truth, const PosedPath& estimate, bool with_rotation,
                       double most_s);

}  // namespace placegraph
