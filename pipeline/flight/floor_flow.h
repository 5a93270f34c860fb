#pragma once
#include <placegraph/frontend/flow/flow_cues.h>
#include <placegraph/frontend/flow/flow_vector.h>
#include <placegraph/frontend/flow/point_tracker.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/core/stage_times.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/image/image.h>
#include <placegraph/graph/measurements/body_state.h>
#include <placegraph/pipeline/flight/flight_options.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace placegraph {

/// Flow measurement between two images.
struct FloorFlowMeasurement {
  /// Outcomes: not attempted (no state at the first image), too few data (fewer than
  /// `FloorFlowOptions::min_points` inliers), those of `ventral_motion`.
  Outcome outcome;
  int inliers = 0;
  double chi2_per_dof = 0;  ///< chi2 of the inliers
  /// Measurement for a filter; empty if `outcome` is no success or if flow is not `enabled`.
  std::optional<FlowMeasurement> observation;
};

/// Optical flow over a level floor: tracks corners from image to image, and converts their flow
/// without the camera's rotation to the camera's translation over its height.
class FloorFlow {
 public:
  /// World: z up, the floor at z = `floor_z_m`. The camera has no distortion. Throws ArgumentError
  /// if an option of the tracker is out of range.
  FloorFlow(const FloorFlowOptions& options, const Camera& camera, const SE3& T_body_cam,
            double floor_z_m);

  /// Tracks the corners into the next image (CV_8UC1) and detects new ones where too few remain.
  /// Returns the flow from the previous image to this one, with covariances. If the states at both
  /// images are known, points are searched for near their predicted positions on the floor. Throws
  /// ArgumentError if the image does not have the camera's size.
  std::vector<FlowVector> track(const Image& image, const std::optional<BodyState>& previous,
                                const std::optional<BodyState>& expected, StageTimes& times);

  /// Measures the motion from the flow between the image of `previous` and the one at `to_ns`;
  /// `rotation` is the camera's rotation between them by the gyro.
  FloorFlowMeasurement measure(const std::vector<FlowVector>& flow,
                               const std::optional<BodyState>& previous, std::int64_t to_ns,
                               const KnownRotation& rotation) const;

 private:
  /// The last search for corners.
  struct Detection {
    std::size_t tracks = 0;  // number of tracks after it
    int images_since = 0;
  };

  std::vector<Eigen::Vector2f> predicted_px(const BodyState& previous,
                                            const BodyState& expected) const;
  std::vector<FlowVector> flow_of_tracks(const Image& image) const;
  bool detection_due() const;

  FloorFlowOptions options_;
  Camera camera_;
  SE3 T_body_cam_;
  double floor_z_m_;
  PointTracker tracker_;
  std::optional<Detection> last_detection_;
};

}  // namespace placegraph
