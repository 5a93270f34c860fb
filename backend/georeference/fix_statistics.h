#pragma once
#include <placegraph/backend/georeference/antenna_trajectory.h>
#include <placegraph/backend/georeference/georeference_report.h>
#include <placegraph/graph/measurements/gps_fix.h>

#include <optional>
#include <vector>

namespace placegraph {

/// Median position of the fixes, robust against gross errors.
/// It is the median of each coordinate, with longitudes relative to the first fix. At least one
/// fix.
GeodeticPosition median_position(const std::vector<GpsFix>& fixes);

/// The gaps without a fix longer than `least_s` between the first and the last visit.
std::vector<GpsDropout> find_dropouts(const std::vector<NodeVisit>& visits,
                                      const std::vector<std::int64_t>& stamps_of_fixes_ns,
                                      double least_s);

/// Residual of a fix against a map.
struct FixResidual {
  std::int64_t stamp_ns = 0;
  Eigen::Vector3d e_enu = Eigen::Vector3d::Zero();  ///< [m]
  double accuracy_m = 1;                            ///< accuracy stated by the receiver [m]
};

/// Whether the error of a fix is larger than that of all right fixes but one in 100,000.
bool is_gross(const Eigen::Vector3d& e_enu, const Eigen::Matrix3d& information);

/// Factors by which fixes scatter more than stated; 1 if they do not.
/// They are estimated from the differences of successive residuals at most `max_gap_s` apart, in
/// which the errors of the map cancel; the median is robust against gross errors. Empty below
/// twenty pairs.
struct FixDispersion {
  double horizontal = 1, vertical = 1;
};
std::optional<FixDispersion> dispersion_of(const std::vector<FixResidual>& residuals,
                                           double max_gap_s);

/// Information of a fix in (east, north, up) [1/m^2] from its standard deviations [m].
Eigen::Matrix3d fix_information(double horizontal_m, double vertical_m);

}  // namespace placegraph
