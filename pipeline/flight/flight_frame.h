#pragma once
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/measurements/body_state.h>
#include <placegraph/graph/measurements/flight_measurement.h>

#include <cstdint>
#include <optional>

namespace [[gnu::visibility("default")]] placegraph {

/// Result of one image.
struct FlightFrame {
  std::int64_t stamp_ns = 0;
  Outcome outcome;  ///< outcome of `state`: see ErrorStateFilter::at
  BodyState state;
  Outcome flow;          ///< whether flow over the floor was measured and accepted
  int flow_points = 0;   ///< inliers of the flow
  double flow_chi2 = 0;  ///< chi2 of the inliers, per degree of freedom
  Outcome markers;       ///< whether a pose by markers was measured and accepted
  /// The measurements, accepted or not, for a smoother that runs in addition to the filter.
  std::optional<FlowMeasurement> flow_measurement;
  std::optional<PoseMeasurement> pose_measurement;
  int markers_seen = 0, beacons_seen = 0;  ///< number used to compute the pose
};

}  // namespace placegraph
