#pragma once
#include <placegraph/backend/georeference/georeference_report.h>
#include <placegraph/backend/internal/georeference/antenna_trajectory.h>
#include <placegraph/graph/measurements/gps_fix.h>

#include <optional>
#include <vector>

namespace placegraph {

/// Of all coordinates by themselves, longitudes relative to the first fix: gross errors do not move
/// it. At least one fix.
GeodeticPosition median_position(const std::vector<GpsFix>& fixes);

/// The times longer than `least_s` between the first and the last visit in which no fix lies.
std::vector<GpsDropout> find_dropouts(const std::vector<NodeVisit>& visits,
                                      const std::vector<std::int64_t>& stamps_of_fixes_ns,
                                      double least_s);

/// What a map leaves of a fix.
struct FixResidual {
  std::int64_t stamp_ns = 0;
  Eigen::Vector3d e_enu = Eigen::Vector3d::Zero();  ///< [m]
  double accuracy_m = 1;                            ///< as the receiver states it
};

/// By which factor fixes scatter more than they state (1 if they do not), from differences of
/// successive residuals at most `max_gap_s` apart: what a map that does not fit leaves cancels in
/// them, and the median passes over gross errors. Nothing below twenty pairs.
struct FixDispersion {
  double horizontal = 1, vertical = 1;
};
std::optional<FixDispersion> dispersion_of(const std::vector<FixResidual>& residuals,
                                           double max_gap_s);

/// Information of a fix in (east, north, up) [1/m^2] from its standard deviations [m].
Eigen::Matrix3d fix_information(double horizontal_m, double vertical_m);

}  // namespace placegraph
