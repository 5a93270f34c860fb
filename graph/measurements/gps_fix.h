#pragma once
#include <placegraph/graph/geometry/geodesy.h>
#include <placegraph/graph/geometry/so3.h>

#include <cstdint>
#include <optional>

namespace [[gnu::visibility("default")]] placegraph {

/// One reading of a GPS receiver, or of a unit that fuses GPS and inertial sensors.
struct GpsFix {
  std::int64_t stamp_ns = 0;  ///< time by the receiver's clock
  GeodeticPosition position;  ///< position of the antenna, or of the reference point of the unit
  double accuracy_m = 0;      ///< standard deviation of each coordinate as stated by the receiver
  std::optional<Eigen::Vector3d> velocity_enu;  ///< velocity: east, north, up [m/s]
  std::optional<SO3> R_enu_body;                ///< attitude; body: forward, left, up
};

}  // namespace placegraph
