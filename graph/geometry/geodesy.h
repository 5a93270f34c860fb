#pragma once
#include <Eigen/Core>

#include <memory>

namespace [[gnu::visibility("default")]] placegraph {

/// A position relative to the WGS84 ellipsoid.
/// The height is used as height above the ellipsoid, even if the receiver has another vertical
/// datum.
struct GeodeticPosition {
  double latitude_deg = 0;   ///< [-90, 90]
  double longitude_deg = 0;  ///< [-540, 540)
  double height_m = 0;       ///< [-1e5, 1e8]

  /// Throws ArgumentError naming the value that is not finite or out of range.
  void check() const;
};

/// The position of UTM coordinates [m] of a zone from 1 to 60, on the ellipsoid.
/// UTMUPS of GeographicLib. Throws ArgumentError for a zone or coordinates that UTM does not have.
GeodeticPosition from_utm(int zone, bool north, double easting_m, double northing_m);

/// Cartesian east-north-up coordinates [m] about an origin.
/// The axes are tangent to the ellipsoid at the origin; there is no map projection, so lengths are
/// true (LocalCartesian of GeographicLib, Karney 2013).
class EnuFrame {
 public:
  /// Throws as GeodeticPosition::check.
  explicit EnuFrame(const GeodeticPosition& origin);

  /// The position whose ENU coordinates are zero.
  const GeodeticPosition& origin() const { return origin_; }
  /// East, north and up of a position [m]; throws as GeodeticPosition::check.
  Eigen::Vector3d to_enu(const GeodeticPosition& position) const;
  /// The inverse of `to_enu`, with the longitude in [-180, 180] degrees.
  GeodeticPosition to_geodetic(const Eigen::Vector3d& position_enu) const;

 private:
  struct Projection;
  GeodeticPosition origin_;
  std::shared_ptr<const Projection> projection_;
};

}  // namespace placegraph
