#pragma once
#include <placegraph/pipeline/odometry/initializer.h>

#include <memory>

namespace placegraph {

/// An empty local map. `measured`: whether the ground or another sensor measures the scale of a
/// monocular camera.
LocalMap make_local_map(const OdometryOptions& options, const Calibration& calibration,
                        bool measured);

/// Source of the scale of a track segment before it begins. `in_known_map`: scale from recognized
/// frames; `depth_known`: or from the previous depth of the scene.
Scale scale_at_start(const OdometryOptions& options, const Calibration& calibration,
                     bool in_known_map, bool depth_known);

/// The frame tracker and the map initializer for the selected cues and the sensors of the
/// calibration.
struct TrackerAndInitializer {
  std::unique_ptr<FrameTracker> tracker;
  std::unique_ptr<Initializer> initializer;  ///< refers to the tracker
};
/// Throws ArgumentError if the cues need a sensor that is missing, or if images are distorted.
/// `times`, which must outlive both, receives the CPU time of their stages.
TrackerAndInitializer make_tracker(const OdometryOptions& options, const Calibration& calibration,
                                   std::uint64_t seed, const LogSink& log, StageTimes& times);

}  // namespace placegraph
