#pragma once
#include <placegraph/graph/geometry/geodesy.h>
#include <placegraph/graph/geometry/trajectory.h>
#include <placegraph/graph/pose_graph/pose_graph.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// What goes on a map: a trajectory and a graph of places in the ENU frame about `origin`.
struct GeoDocument {
  std::string name;  ///< title of the document
  GeodeticPosition origin;
  Trajectory trajectory;  ///< T_enu_body; a lost frame interrupts the line
  PoseGraph graph;        ///< T_enu_node: nodes as points, relative poses as lines between them
  /// One per node of `graph`, or empty.
  std::vector<std::int64_t> node_stamps_ns;
};

/// GeoJSON (RFC 7946): a FeatureCollection of the origin (Point), the trajectory (MultiLineString),
/// the edges (MultiLineString, properties from, to, source) and the nodes (Point, properties id,
/// stamp_ns). Coordinates are [longitude, latitude, height] on WGS84, 9 and 4 digits; lines are cut
/// where they cross the 180th meridian. The top-level member `placegraph` repeats the origin.
/// Atomically; throws FileError, and ArgumentError for an invalid origin or a number of
/// stamps that is not that of the nodes.
void write_geojson(const std::string& path, const GeoDocument& document);

/// The same as KML 2.2, in folders "trajectory", "edges" and "nodes". Programs draw it on the
/// ground (clampToGround): KML counts heights from the sea level, GPS from the ellipsoid. The
/// origin stands in the document's description and as a placemark.
void write_kml(const std::string& path, const GeoDocument& document);

}  // namespace placegraph
