#pragma once
#include <placegraph/pipeline/odometry/initializer.h>
#include <placegraph/pipeline/odometry/local_mapping.h>
#include <placegraph/pipeline/tracking/feature_tracker.h>

#include <opencv2/core.hpp>
#include <string>
#include <type_traits>

namespace placegraph::test {

/// The parts of an odometry that begins its map with an initializer, a TwoViewInitializer or a
/// LineViewInitializer, the first frame at `T_odom_start`.
template <class Initializer>
struct Beginning {
  StageTimes times;
  Calibration calibration;
  OdometryOptions options;
  FeatureTracker tracker;
  LocalMapping mapping;
  LocalMap map;
  Initializer initializer;
  SE3 T_odom_start;

  Beginning(const Calibration& by, const std::string& cues, Scale scale, const SE3& T_odom_first)
      : calibration(by),
        options(with_cues(cues)),
        tracker(options, calibration, 1, {}, times),
        mapping(options, calibration, {}, times),
        map(options.window, calibration.camera, scale),
        initializer(initializer_of(options, calibration, tracker, times)),
        T_odom_start(T_odom_first) {
    initializer.restart(T_odom_start);
  }
  static OdometryOptions with_cues(const std::string& cues) {
    OdometryOptions options;
    options.cues = cues;
    return options;
  }
  static Initializer initializer_of(const OdometryOptions& options, const Calibration& calibration,
                                    FeatureTracker& tracker, StageTimes& times) {
    if constexpr (std::is_constructible_v<Initializer, const OdometryOptions&, const Calibration&,
                                          int, FeatureTracker&, LogSink, StageTimes&>)
      return Initializer(options, calibration, 1, tracker, {}, times);
    else
      return Initializer(options, calibration, 1, tracker, {});
  }
  Initialization add(const Frame& frame, const std::optional<SE3>& T_odom_cam_known = {}) {
    return initializer.add(frame, T_odom_cam_known, map, mapping);
  }
  /// The frame as if no light had fallen on it.
  Initialization add_dark(Frame frame) {
    frame.image = Image(frame.image.size(), CV_8UC1, cv::Scalar(0));
    return add(frame);
  }
  /// From the first keyframe to the newest.
  SE3 motion() const { return map.pose(map.first()).inverse() * map.pose(map.newest()); }
};

}  // namespace placegraph::test
