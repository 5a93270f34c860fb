#pragma once
#include <placegraph/pipeline/run.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// The elements of visual navigation that a run uses (Siddiqui 2014).
struct Elements {
  bool motion = false;    ///< tracking and sliding-window optimization
  bool spatial = false;   ///< place recognition and loop closure
  bool geometry = false;  ///< planes, lines and Manhattan frames as cues; floor plan
  /// Classification of the environment and the assumptions that follow from it.
  bool context = false;
  bool semantics = false;  ///< surface labels for odometry and place recognition
};

/// Parses element names joined by commas, as in "motion,spatial".
///
/// Throws ArgumentError for an unknown name, for a duplicate name, or if motion is missing, because
/// no other element estimates the camera's motion.
Elements parse_elements(const std::string& names);

/// Enables or disables each element in the options of a run.
///
/// `spatial` sets `loops.enabled`; `geometry` sets the cues to "points,lines,plane,manhattan"
/// instead of "points", and sets `scene.geometry`; `context` sets `context.enabled`; `semantics`
/// sets `semantics.enabled` and `scene.semantics`.
void set_elements(const Elements& elements, RunOptions& options);

/// Adds the cues that reduce rotation drift in a floor plan.
///
/// Adds `manhattan` to the cues if points are among them, and enables plane landmarks from depth
/// images, as `placegraph run --elements geometry` does. Throws ArgumentError for cues that
/// OdometryOptions::check() rejects.
void enable_manhattan_and_planes(RunOptions& options);

}  // namespace placegraph
