#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/core/log.h>
#include <placegraph/graph/measurements/measured_motion.h>
#include <placegraph/pipeline/cues/manhattan_cue.h>
#include <placegraph/pipeline/lines/line_cue.h>
#include <placegraph/pipeline/local_map/keyframe_masks.h>
#include <placegraph/pipeline/local_map/local_map.h>
#include <placegraph/pipeline/scale/floor_line_scale.h>
#include <placegraph/pipeline/scale/ground_plane_scale.h>

#include <map>
#include <memory>
#include <optional>

namespace placegraph {

/// A length that the ground under the camera gives, compared with that of the tracked points.
struct ScaleComparison {
  KeyframeId keyframe;    ///< keyframe at which it was measured
  double log_factor = 0;  ///< logarithm of the length by the ground over that by the points
};

/// Estimates the metric scale of a monocular map: from the ground plane or lines on the floor under
/// a camera of known height, or from motion measured by another sensor. Until the scale is known, a
/// measurement rescales the map; afterwards each one is a distance constraint in the window.
class MetricScale {
 public:
  explicit MetricScale(LogSink log) : log_(std::move(log)) {}
  /// Enables a source of measurements; any number of sources may be used.
  void use_ground_plane(const GroundPlaneScaleOptions& options, const Camera& camera,
                        double height_m);
  void use_floor_lines(const FloorLineScaleOptions& options, const Camera& camera, double height_m);
  void use_motion(std::shared_ptr<const MeasuredMotion> motion_cam);
  /// Whether any source is available.
  bool available() const { return ground_ || floor_ || motion_; }
  bool uses_ground_plane() const { return ground_.has_value(); }
  bool uses_floor_lines() const { return floor_.has_value(); }
  /// Sets whether the ground is assumed to be at the camera's height below the camera.
  void trust_height(bool trusted) { height_trusted_ = trusted; }
  void reset();

  /// Cues of a keyframe; null: not among the cues, or not accepted.
  struct Cues {
    const LineCue* lines = nullptr;
    const ManhattanCue* manhattan = nullptr;
  };
  /// Stores a keyframe of the map, not the newest one, for later measurements.
  void remember(KeyframeId keyframe, const Frame& frame);
  /// Measures at the newest keyframe of the map. Returns the change of its lengths, if there is
  /// one.
  std::optional<Rescale> measure(const KeyframeImages& images, const Cues& cues, LocalMap& map);
  /// The newest measurement by the ground of a map whose scale was known.
  const std::optional<ScaleComparison>& compared() const { return compared_; }
  /// Outline in the image of the ground plane that is measured; empty if there is none.
  std::vector<Eigen::Vector2d> ground_outline_px() const;

 private:
  std::optional<Rescale> measure_ground(const KeyframeImages& images, const Cues& cues,
                                        LocalMap& map);
  std::optional<Rescale> measure_floor(const Cues& cues, LocalMap& map);
  std::optional<Rescale> measure_motion(LocalMap& map);
  std::optional<DistanceObservation> measured_distance(KeyframeId from, KeyframeId to) const;
  GroundMask ground_in(const KeyframeImages& images, const Cues& cues) const;

  LogSink log_;
  std::optional<GroundPlaneScale> ground_;
  std::optional<FloorLineScale> floor_;
  std::shared_ptr<const MeasuredMotion> motion_;
  bool height_trusted_ = true;
  std::map<KeyframeId, std::int64_t> stamps_ns_;  // time stamps of the segment's keyframes
  std::optional<ScaleComparison> compared_;
  std::map<KeyframeId, Frame> frames_;  // frames of the window, where the ground is measured
};

}  // namespace placegraph
