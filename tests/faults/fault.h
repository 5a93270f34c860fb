#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tests/faults/recording.h"

namespace placegraph::faults {

/// A fault of a recording: what it changes, and what a judgement of the run must name.
struct Fault {
  std::string name;
  std::string sensors;  ///< the runs it concerns: "mono stereo rgbd" or some of them
  std::string what;     ///< one line
  std::string causes;   ///< codes of which a judgement must name one, joined by '|'; "-": none
  /// The recording with the fault; the seed fixes all random numbers.
  std::function<Recording(const Recording&, std::uint32_t seed)> apply;
};

/// Cause of a stated length that is wrong by a plausible factor: the judgement must say that the
/// scale rests on it and that nothing in the recording checks it.
inline constexpr const char* kUnchecked = "|scale_unchecked";
/// Within this factor a stated length is plausible: the recording is that of a larger world.
inline bool is_plausible(double factor) { return factor >= 0.5 && factor <= 2; }

/// The faults of one kind, in a fixed order.
std::vector<Fault> optics_faults();
std::vector<Fault> overlay_faults();
std::vector<Fault> timing_faults();
std::vector<Fault> calibration_faults();
std::vector<Fault> stereo_faults();
std::vector<Fault> scene_faults();
std::vector<Fault> motion_faults();
std::vector<Fault> depth_faults();

/// All faults: the kinds one after the other. Names are unique.
std::vector<Fault> all_faults();

/// The group of the fault at a position of the table: "fixed" or "held", in turn.
/// The rule looks at the position alone, so that no result can have chosen the held ones.
inline std::string group_of(std::size_t position) { return position % 2 == 0 ? "fixed" : "held"; }

}  // namespace placegraph::faults
