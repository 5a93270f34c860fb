#pragma once
#include <placegraph/frontend/internal/lines/floor_from_lines.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/pipeline/cues/cue_options.h>
#include <placegraph/pipeline/internal/scale/ground_plane_scale.h>

#include <deque>
#include <optional>
#include <set>

namespace placegraph {

/// Metric scale from lines on the floor under a camera of known height.
class FloorLineScale {
 public:
  FloorLineScale(const FloorLineScaleOptions& options, const Camera& camera,
                 double camera_height_m);

  /// What all lengths must be multiplied by, from lines of a scene whose unit is arbitrary
  /// (`scale_known` false, which a few views must agree on) or roughly the metre; nothing if no
  /// floor is seen or nothing new of it: a line on the floor is heard once in a known unit.
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
  std::set<LineId> heard_;
  std::deque<double> first_log_factors_;  // before the unit is known
  std::deque<double> recent_log_factors_;
};

}  // namespace placegraph
