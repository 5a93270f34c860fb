#include <placegraph/graph/core/error.h>
#include <placegraph/graph/geometry/geodesy.h>

#include <GeographicLib/LocalCartesian.hpp>
#include <GeographicLib/UTMUPS.hpp>
#include <cmath>
#include <sstream>

namespace placegraph {

struct EnuFrame::Projection {
  GeographicLib::LocalCartesian cartesian;
};

void GeodeticPosition::check() const {
  const auto require_range = [](const char* what, double value, double min, double max) {
    std::ostringstream message;
    message << what << ": " << value << " outside [" << min << ", " << max << "]";
    require(value >= min && value <= max, message.str());
  };
  require_range("latitude", latitude_deg, -90, 90);
  require_range("longitude", longitude_deg, -540, std::nextafter(540.0, 0.0));
  require_range("height", height_m, -1e5, 1e8);
}

GeodeticPosition from_utm(int zone, bool north, double easting_m, double northing_m) {
  require(zone >= 1 && zone <= 60, "UTM: there is no zone " + std::to_string(zone));
  GeodeticPosition position;
  try {
    GeographicLib::UTMUPS::Reverse(zone, north, easting_m, northing_m, position.latitude_deg,
                                   position.longitude_deg);
  } catch (const GeographicLib::GeographicErr& error) {
    throw ArgumentError(std::string("UTM: ") + error.what());
  }
  return position;
}

EnuFrame::EnuFrame(const GeodeticPosition& origin) : origin_(origin) {
  origin.check();
  projection_ = std::make_shared<const Projection>(Projection{
      GeographicLib::LocalCartesian(origin.latitude_deg, origin.longitude_deg, origin.height_m)});
}

Eigen::Vector3d EnuFrame::to_enu(const GeodeticPosition& position) const {
  position.check();
  Eigen::Vector3d enu;
  projection_->cartesian.Forward(position.latitude_deg, position.longitude_deg, position.height_m,
                                 enu[0], enu[1], enu[2]);
  return enu;
}

GeodeticPosition EnuFrame::to_geodetic(const Eigen::Vector3d& position_enu) const {
  GeodeticPosition position;
  projection_->cartesian.Reverse(position_enu[0], position_enu[1], position_enu[2],
                                 position.latitude_deg, position.longitude_deg, position.height_m);
  return position;
}

}  // namespace placegraph
