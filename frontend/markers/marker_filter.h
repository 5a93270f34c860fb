#pragma once
#include <placegraph/frontend/markers/beacon_pose.h>
#include <placegraph/frontend/markers/marker_detector.h>
#include <placegraph/frontend/markers/marker_options.h>
#include <placegraph/frontend/markers/square_pose.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/measurements/body_state.h>
#include <placegraph/graph/measurements/marker_layout.h>

#include <optional>
#include <vector>

namespace placegraph {

/// Observations in one image, and inertial measurements at its time.
struct MarkerView {
  std::int64_t stamp_ns = 0;
  std::vector<MarkerObservation> markers;
  std::vector<BeaconObservation> beacons;
  /// Mean of the accelerometer about that time (specific force, up if the body is at rest), if
  /// there is one.
  std::optional<Eigen::Vector3d> force_body;
  /// Rotation of the body since the last view (R_last_now) from the gyro, if there is one.
  std::optional<SO3> rotation_body;
};

/// One hypothesis about the pose of the body.
struct MarkerHypothesis {
  SE3 T_world_body;
  Matrix6d covariance = Matrix6d::Zero();  ///< right tangent
  double chi2 = 0;                         ///< squared error of this view's corners and spots
  double log_likelihood_sum = 0;  ///< log-likelihood over all views of the hypothesis and all
  ///< present measurements, relative to the best hypothesis
  double followed = 0;  ///< part of that sum that is kept for the next view
};

/// Pose of the body from markers and beacons.
struct MarkerPoseEstimate {
  /// Outcomes: too few data (nothing known in view), inconsistent (two poses are still possible;
  /// the filter or the other markers contradict all), degenerate.
  Outcome outcome;
  PoseMeasurement observation;               ///< meaningful only if outcome
  int markers = 0, beacons = 0;              ///< numbers used in the pose
  std::vector<MarkerHypothesis> hypotheses;  ///< remaining hypotheses, best first
};

/// Estimates poses of the body from markers and beacons at known positions (Siddiqui 2014, 2.1).
///
/// Two poses explain a single marker almost equally well. Both are kept as hypotheses until the
/// prediction of the position filter, the vertical, the rotation of the body between images and the
/// other markers in view reject one of them; until then there is no estimate. Markers and beacons
/// in view are solved together.
class MarkerFilter {
 public:
  /// Throws ArgumentError for an option out of range, an invalid camera or an empty layout.
  MarkerFilter(const MarkerFilterOptions& options, MarkerLayout layout, const Camera& camera,
               const SE3& T_body_cam);

  /// Estimates the body's pose from the next view; views are in the order of their times.
  ///
  /// `expected`, if given, is the body's state as predicted by another estimator at the view's
  /// time; without it only the layout and the sensors are used.
  MarkerPoseEstimate observe(const MarkerView& view, const BodyExpectation* expected = nullptr);
  /// Predicted images of the layout's markers, for MarkerDetector::detect_near.
  ///
  /// Markers that are in view completely, or up to the uncertainty of the pose (right tangent of
  /// T_world_body).
  std::vector<ExpectedSquare> expected_squares(const SE3& T_world_body,
                                               const Matrix6d& covariance) const;
  void forget() { hypotheses_.clear(); }

 private:
  std::vector<SeenSquare> known_squares(const MarkerView& view) const;
  std::vector<MarkerHypothesis> explain(const MarkerView& view, MarkerPoseEstimate& estimate,
                                        const BodyExpectation* expected) const;
  void weigh(const MarkerView& view, const BodyExpectation* expected,
             std::vector<MarkerHypothesis>& hypotheses) const;

  MarkerFilterOptions options_;
  MarkerLayout layout_;
  Camera camera_;
  SE3 T_body_cam_;
  std::vector<MarkerHypothesis> hypotheses_;  // hypotheses of the last view
  std::int64_t last_ns_ = 0;
};

}  // namespace placegraph
