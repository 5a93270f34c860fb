#pragma once
#include <placegraph/pipeline/internal/odometry/initializer.h>

#include <memory>

namespace placegraph {

/// An empty local map. `measured`: whether the ground or another sensor measures the scale of a
/// monocular camera.
LocalMap make_local_map(const OdometryOptions& options, const Calibration& calibration,
                        bool measured);

/// Where the scale of a track segment comes from before it has begun. `in_known_map`: from frames
/// that are recognized; `depth_known`: or from how far away things were before.
Scale scale_at_start(const OdometryOptions& options, const Calibration& calibration,
                     bool in_known_map, bool depth_known);

/// How frames are tracked, and how a map begins: by the cues that the options name and the sensors
/// that the calibration has.
struct TrackerAndInitializer {
  std::unique_ptr<FrameTracker> tracker;
  std::unique_ptr<Initializer> initializer;  ///< refers to the tracker
};
/// Throws ArgumentError if the cues need a sensor that is not there, or images are distorted.
/// `times`, which must outlive both, receives the CPU time of their stages.
TrackerAndInitializer make_tracker(const OdometryOptions& options, const Calibration& calibration,
                                   std::uint64_t seed, const LogSink& log, StageTimes& times);

}  // namespace placegraph
