#pragma once
#include <placegraph/frontend/markers/beacon_detector.h>
#include <placegraph/frontend/markers/marker_detector.h>
#include <placegraph/frontend/markers/marker_filter.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/core/stage_times.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/image/image.h>
#include <placegraph/graph/measurements/body_state.h>
#include <placegraph/graph/measurements/marker_layout.h>
#include <placegraph/pipeline/flight/flight_options.h>

#include <optional>
#include <vector>

namespace placegraph {

/// The markers and beacons in one image.
struct MarkerDetections {
  std::vector<MarkerObservation> markers;
  std::vector<BeaconObservation> beacons;
};

/// Estimates poses of the body from markers and beacons of a layout, and selects the image regions
/// to search: near their expected positions, or the whole image if there is no expectation or no
/// marker has been accepted for a while.
class MarkerSensor {
 public:
  /// The camera has no distortion. Throws ArgumentError if an option is out of range, or if the
  /// layout has neither markers nor beacons.
  MarkerSensor(const MarkerSensorOptions& options, const Camera& camera, const SE3& T_body_cam,
               const MarkerLayout& layout);

  /// Searches an image (CV_8UC1). `expected` is the state of the body at that image, if it is
  /// known. Beacons are searched for where one may be in view and fewer than three markers are
  /// found.
  MarkerDetections detect(const Image& image, const std::optional<BodyState>& expected,
                          StageTimes& times);
  /// Estimates the pose from the detections in one image, with the help of the expectation if it
  /// `relies_on` that. Outcomes: those of MarkerFilter::observe.
  MarkerPoseEstimate estimate(const MarkerView& view, const BodyExpectation& expectation);
  /// Reports the result of the pose of one image: whether the estimator accepted it, and whether
  /// the image shows markers.
  void report(const Outcome& accepted, bool markers_in_view);
  /// Whether markers have contradicted the expected states in `restart_after` consecutive images,
  /// so that the markers are assumed to be correct, until a pose is accepted.
  bool is_refuted() const { return contradictions_ >= options_.restart_after; }
  /// Whether there is an expected state, and markers have not refuted such states.
  bool relies_on(const BodyExpectation& expectation) const {
    return expectation.state.has_value() && !is_refuted();
  }

 private:
  std::vector<ExpectedSquare> expected_squares(const BodyState& expected) const;
  bool beacons_in_view(const BodyState& expected) const;

  MarkerSensorOptions options_;
  Camera camera_;
  SE3 T_body_cam_;
  std::vector<Eigen::Vector3d> beacons_world_;
  std::optional<MarkerDetector> detector_;  // nothing: the layout has beacons only
  MarkerFilter filter_;
  int contradictions_ = 0;      // number of consecutive images
  int images_since_found_ = 0;  // since a pose was accepted or a whole image was searched
};

}  // namespace placegraph
