#pragma once
#include <placegraph/frontend/internal/markers/beacon_pose.h>
#include <placegraph/frontend/internal/markers/marker_detector.h>
#include <placegraph/frontend/internal/markers/marker_options.h>
#include <placegraph/frontend/internal/markers/square_pose.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/internal/measurements/body_state.h>
#include <placegraph/graph/internal/measurements/marker_layout.h>

#include <optional>
#include <vector>

namespace placegraph {

/// What one image shows, and what is known of the body at its time.
struct MarkerView {
  std::int64_t stamp_ns = 0;
  std::vector<MarkerObservation> markers;
  std::vector<BeaconObservation> beacons;
  /// The accelerometer's mean about that time (specific force, up where the body is at rest), if
  /// there is one.
  std::optional<Eigen::Vector3d> force_body;
  /// The body's turn since the last view (R_last_now), as the gyro has it, if there is one.
  std::optional<SO3> rotation_body;
};

/// One way to explain what is seen.
struct MarkerHypothesis {
  SE3 T_world_body;
  Matrix6d covariance = Matrix6d::Zero();  ///< right tangent
  double chi2 = 0;                         ///< of this view's corners and spots
  double log_likelihood_sum = 0;  ///< log-likelihood over the views it was followed through, with
                                  ///< all that speaks for it now; 0 for the best
  double followed = 0;  ///< what of that is kept for the next view
};

struct MarkerPoseEstimate {
  /// Outcomes: too few data (nothing known in view), inconsistent (two poses are still possible;
  /// the filter or the other markers contradict all), degenerate.
  Outcome outcome;
  PoseMeasurement observation;               ///< meaningful only if outcome
  int markers = 0, beacons = 0;              ///< that shaped it
  std::vector<MarkerHypothesis> hypotheses;  ///< those still possible, best first
};

/// From markers and beacons of known places to poses of the body (Siddiqui 2014, 2.1). A single
/// marker is explained by two poses nearly alike: both are kept, and what the position filter
/// expects, where up is, how the body turned between images and the other markers in view speak for
/// one of them until the other is refuted; until then there is no answer. Markers and beacons in
/// view are solved together.
class MarkerFilter {
 public:
  /// Throws ArgumentError if an option is out of range, the camera is none, or the layout is empty.
  MarkerFilter(const MarkerFilterOptions& options, MarkerLayout layout, const Camera& camera,
               const SE3& T_body_cam);

  /// Views come in the order of their times. `expected`, if given, is the body as another estimator
  /// expects it at the view's time; without it the layout and the sensors decide.
  MarkerPoseEstimate observe(const MarkerView& view, const BodyExpectation* expected = nullptr);
  /// Where a camera at this pose would see the layout's markers, wholly or but for what the pose
  /// leaves open (right tangent of T_world_body): for MarkerDetector::detect_near.
  std::vector<ExpectedSquare> expected_squares(const SE3& T_world_body,
                                               const Matrix6d& covariance) const;
  void forget() { hypotheses_.clear(); }

 private:
  std::vector<SeenSquare> known_squares(const MarkerView& view) const;
  std::vector<MarkerHypothesis> explain(const MarkerView& view, MarkerPoseEstimate& answer,
                                        const BodyExpectation* expected) const;
  void weigh(const MarkerView& view, const BodyExpectation* expected,
             std::vector<MarkerHypothesis>& hypotheses) const;

  MarkerFilterOptions options_;
  MarkerLayout layout_;
  Camera camera_;
  SE3 T_body_cam_;
  std::vector<MarkerHypothesis> hypotheses_;  // of the last view
  std::int64_t last_ns_ = 0;
};

}  // namespace placegraph
