#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/odometry/first_frame_initializer.h>
#include <placegraph/pipeline/odometry/line_view_initializer.h>
#include <placegraph/pipeline/odometry/odometry_parts.h>
#include <placegraph/pipeline/odometry/two_view_initializer.h>
#include <placegraph/pipeline/tracking/cue_list.h>
#include <placegraph/pipeline/tracking/direct_tracker.h>

namespace placegraph {

LocalMap make_local_map(const OdometryOptions& options, const Calibration& calibration,
                        bool measured) {
  const Scale scale = scale_at_start(options, calibration, false, false);
  SlidingWindowOptions window = options.window;
  if (measured) window.scale_drift = options.scale_drift;
  // A monocular map passes its scale on through the pose of the window, which the prior must
  // constrain.
  if (scale == Scale::kMetric) window.hold_oldest = true;
  window.depths_from_disparities = calibration.baseline_m > 0 && !calibration.depth;
  return LocalMap(window, calibration.camera, scale);
}

Scale scale_at_start(const OdometryOptions& options, const Calibration& calibration,
                     bool in_known_map, bool depth_known) {
  if (metric_from_start(parse_cues(options.cues), calibration)) return Scale::kMetric;
  if (in_known_map) return Scale::kFromMap;
  return depth_known ? Scale::kGuessed : Scale::kArbitrary;
}

TrackerAndInitializer make_tracker(const OdometryOptions& options, const Calibration& calibration,
                                   std::uint64_t seed, const LogSink& log, StageTimes& times) {
  const Cues cues = parse_cues(options.cues);
  const bool metric = metric_from_start(cues, calibration);
  require(calibration.camera.distortion == Distortion::kNone,
          "calibration.camera: undistorted images needed (rectify them first)");
  require(!cues.without_features() || metric,
          "cues: surfaces without points require a right camera, depth or the camera's height");
  require(!cues.direct || metric || calibration.camera_height_m,
          "cues: direct requires a right camera, depth or the camera's height");
  TrackerAndInitializer parts;
  if (cues.without_features()) {
    parts.tracker = std::make_unique<DirectTracker>(options, calibration, seed, log, times);
    parts.initializer = std::make_unique<FirstFrameInitializer>(*parts.tracker, log);
    return parts;
  }
  auto features = std::make_unique<FeatureTracker>(options, calibration, seed, log, times);
  if (metric)
    parts.initializer = std::make_unique<FirstFrameInitializer>(*features, log);
  else if (cues.points)
    parts.initializer =
        std::make_unique<TwoViewInitializer>(options, calibration, seed, *features, log, times);
  else
    parts.initializer =
        std::make_unique<LineViewInitializer>(options, calibration, seed, *features, log);
  parts.tracker = std::move(features);
  return parts;
}

}  // namespace placegraph
