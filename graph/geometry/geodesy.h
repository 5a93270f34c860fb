#pragma once
#include <Eigen/Core>

#include <memory>

namespace [[gnu::visibility("default")]] placegraph {

/// A position on the WGS84 ellipsoid. What the height is measured from is the receiver's affair; it
/// is treated as height above the ellipsoid.
struct GeodeticPosition {
  double latitude_deg = 0;   ///< [-90, 90]
  double longitude_deg = 0;  ///< [-540, 540)
  double height_m = 0;       ///< [-1e5, 1e8]

  /// Throws ArgumentError naming the value that is not finite or out of range.
  void check() const;
};

/// East-north-up coordinates [m] about an origin: Cartesian, tangent to the ellipsoid at the
/// origin, no map projection, so that lengths are true (LocalCartesian of GeographicLib, Karney
/// 2013).
class EnuFrame {
 public:
  /// Throws as GeodeticPosition::check.
  explicit EnuFrame(const GeodeticPosition& origin);

  const GeodeticPosition& origin() const { return origin_; }
  /// Throws as GeodeticPosition::check.
  Eigen::Vector3d to_enu(const GeodeticPosition& position) const;
  /// Longitude in [-180, 180].
  GeodeticPosition to_geodetic(const Eigen::Vector3d& position_enu) const;

 private:
  struct Projection;
  GeodeticPosition origin_;
  std::shared_ptr<const Projection> projection_;
};

}  // namespace placegraph
