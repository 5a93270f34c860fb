#pragma once
#include <placegraph/pipeline/run.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// The elements of visual navigation that a run uses (Siddiqui 2014).
struct Elements {
  bool motion = false;     ///< tracking and the sliding window
  bool spatial = false;    ///< places recognized, loops closed
  bool geometry = false;   ///< planes, lines and Manhattan frames as cues; the floor plan
  bool context = false;    ///< the kind of environment and what is assumed there
  bool semantics = false;  ///< labels of surfaces for motion and places
};

/// Reads names joined by commas, as in "motion,spatial".
///
/// Throws ArgumentError for an unknown name, one named twice, or if motion is not among them:
/// nothing else says how the camera moves.
Elements parse_elements(const std::string& names);

/// Turns each element on or off in the options of a run.
///
/// Spatial is `loops.enabled`; geometry the cues
/// "points,lines,plane,manhattan" instead of "points", and `scene.geometry`; context
/// `context.enabled`; semantics `semantics.enabled` and `scene.semantics`.
void set_elements(const Elements& elements, RunOptions& options);

/// Adds the cues that steady the poses of a floor plan.
///
/// Adds `manhattan` to the cues if points are among them, and enables planes in depth images as
/// landmarks, as `placegraph run --scene geometry` does. Throws ArgumentError for cues that
/// OdometryOptions::check() refuses.
void steady_for_plan(RunOptions& options);

}  // namespace placegraph
