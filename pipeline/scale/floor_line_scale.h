#pragma once
#include <placegraph/frontend/lines/floor_from_lines.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/pipeline/cues/cue_options.h>
#include <placegraph/pipeline/scale/ground_plane_scale.h>

#include <deque>
#include <optional>
#include <set>

namespace placegraph {

/// Metric scale from lines on the floor under a camera of known height.
class FloorLineScale {
 public:
  FloorLineScale(const FloorLineScaleOptions& options, const Camera& camera,
                 double camera_height_m);

  /// Measures the factor for all lengths, from lines of a scene whose scale is arbitrary
  /// (`scale_known` false; a few views must then agree on it) or approximately metric. Nothing if
  /// no floor is seen or if it provides no new information: with a known scale, a line on the floor
  /// is used once.
  std::optional<GroundPlaneScale::ScaleMeasurement> measure(
      const SE3& T_odom_cam, const std::vector<PlacedLine>& lines,
      const std::vector<SharedDirection>& shared, bool scale_known);
  double min_baseline_m() const { return 0.6 * camera_height_m_; }
  void reset();

 private:
  std::optional<GroundPlaneScale::ScaleMeasurement> agreed(double log_factor, double sigma);

  FloorLineScaleOptions options_;
  Camera camera_;
  double camera_height_m_;
  std::set<LineId> used_;
  std::deque<double> first_log_factors_;  // before the scale is known
  std::deque<double> recent_log_factors_;
};

}  // namespace placegraph
