#pragma once
#include <placegraph/pipeline/run.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// The elements of visual navigation (Siddiqui 2014), which share what they find.
struct Elements {
  bool motion = false;     ///< tracking and the sliding window
  bool spatial = false;    ///< places recognized, loops closed
  bool geometry = false;   ///< planes, lines and rectangular worlds; the floor plan
  bool context = false;    ///< kinds of environments and what is assumed in them
  bool semantics = false;  ///< labels of surfaces for motion and places
};

/// From names joined by commas, as in "motion,spatial". Throws ArgumentError for an unknown name,
/// one named twice, or if motion is not among them: nothing else says how the camera moves.
Elements parse_elements(const std::string& names);

/// Turns each element on or off: spatial is `loops.enabled`; geometry the cues
/// "points,lines,plane,manhattan" instead of "points", and `scene.geometry`; context
/// `context.enabled`; semantics `semantics.enabled` and `scene.semantics`.
void set_elements(const Elements& elements, RunOptions& options);

/// A floor plan is as good as its poses: adds `manhattan` to the cues, if points are among them,
/// and planes in depth to the landmarks, as `placegraph run --scene geometry` does.
void steady_for_plan(RunOptions& options);

}  // namespace placegraph
