#pragma once
#include <placegraph/graph/geometry/geodesy.h>
#include <placegraph/graph/geometry/trajectory.h>
#include <placegraph/graph/pose_graph/pose_graph.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// A trajectory and a pose graph in the ENU frame about `origin`, for export to a map.
struct GeoDocument {
  std::string name;         ///< title of the document
  GeodeticPosition origin;  ///< origin of the local east-north-up frame, on WGS84
  Trajectory trajectory;    ///< T_enu_body; the line is interrupted at a lost frame
  PoseGraph graph;          ///< T_enu_node: nodes as points, relative poses as lines between them
  /// Times of the nodes [ns], one per node of `graph`, or empty.
  std::vector<std::int64_t> node_stamps_ns;
};

/// Writes a document as GeoJSON (RFC 7946).
///
/// A FeatureCollection of the origin (Point), the trajectory (MultiLineString), the edges
/// (MultiLineString, properties from, to, source) and the nodes (Point, properties id, stamp_ns).
/// Coordinates are [longitude, latitude, height] on WGS84 [deg, deg, m] with 9, 9 and 4 decimals;
/// lines are cut where they cross the 180th meridian. The top-level member `placegraph` repeats the
/// origin. The file is replaced as a whole or not at all. Throws FileError if it cannot be written,
/// ArgumentError for an invalid origin or if the numbers of stamps and nodes differ.
void write_geojson(const std::string& path, const GeoDocument& document);

/// Writes a document as KML 2.2, in folders "trajectory", "edges" and "nodes".
///
/// Programs draw it on the ground (clampToGround), because KML counts heights from sea level and
/// GPS from the ellipsoid. The description of the document and a placemark contain the origin.
/// Throws as write_geojson.
void write_kml(const std::string& path, const GeoDocument& document);

}  // namespace placegraph
