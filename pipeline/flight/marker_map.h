#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/measurements/marker_layout.h>
#include <placegraph/graph/pose_graph/pose_graph.h>

#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

class Dataset;
struct FlightOptions;
struct FlightRun;

/// A marker of a map.
struct MappedMarker {
  PlacedMarker marker;  ///< with its estimated pose
  /// Right tangent of T_world_marker; zero if the marker was known.
  Matrix6d covariance = Matrix6d::Zero();
  int views = 0;  ///< number of images in which it was seen
};

/// Markers mapped after a flight.
struct MarkerMap {
  /// Outcomes: too few data (no marker was seen often enough), those of the optimizer.
  Outcome outcome;
  std::vector<MappedMarker> markers;  ///< in the order of their ids
  PoseGraph graph;                    ///< frames by number, markers by marker_node
  /// The markers as a layout, for MarkerFilter.
  MarkerLayout layout(const std::string& dictionary) const;
};

/// The node of a marker in the graph.
NodeId marker_node(int id);

/// Maps the markers of `layout.unplaced_sides_m` after a flight.
///
/// Its images are searched again, and `map_markers` is called with the estimated motions between
/// them. The uncertainty of the motions
/// consists of the flow's covariance over the floor (the velocity's where there was no flow), the
/// gyro's noise, the uncertainty of its bias, and the filter's corrections in between. Markers of
/// the layout anchor the map; without such a marker, the world frame is that of the flight. Throws
/// as the data set does. Outcomes: those of map_markers.
[[nodiscard]] MarkerMap map_flight_markers(const Dataset& images, const FlightRun& run,
                                           const SE3& T_body_cam, const MarkerLayout& layout,
                                           const FlightOptions& options);

}  // namespace placegraph
