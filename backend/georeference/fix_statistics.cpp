#include <placegraph/backend/georeference/fix_statistics.h>
#include <placegraph/graph/core/chi_squared.h>
#include <placegraph/graph/core/median.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

constexpr double kMedianOfNormal = 0.6745;  ///< median of |x| for x of unit deviation
// Pairs for a median. Chosen.
constexpr std::size_t kLeastPairs = 20;

}  // namespace

GeodeticPosition median_position(const std::vector<GpsFix>& fixes) {
  std::vector<double> latitudes, longitudes, heights;
  const double reference = fixes.front().position.longitude_deg;
  for (const GpsFix& fix : fixes) {
    latitudes.push_back(fix.position.latitude_deg);
    longitudes.push_back(std::remainder(fix.position.longitude_deg - reference, 360.0));
    heights.push_back(fix.position.height_m);
  }
  return {median_of(latitudes), std::remainder(reference + median_of(longitudes), 360.0),
          median_of(heights)};
}

std::vector<GpsDropout> find_dropouts(const std::vector<NodeVisit>& visits,
                                      const std::vector<std::int64_t>& stamps_of_fixes_ns,
                                      double least_s) {
  std::vector<GpsDropout> dropouts;
  if (visits.empty()) return dropouts;
  const auto [first, last] =
      std::minmax_element(visits.begin(), visits.end(),
                          [](const auto& a, const auto& b) { return a.stamp_ns < b.stamp_ns; });
  std::int64_t begin = first->stamp_ns;
  const auto consider = [&](std::int64_t end) {
    if (1e-9 * static_cast<double>(end - begin) > least_s) dropouts.push_back({begin, end});
  };
  for (const std::int64_t stamp : stamps_of_fixes_ns) {
    if (stamp < first->stamp_ns || stamp > last->stamp_ns) continue;
    consider(stamp);
    begin = stamp;
  }
  consider(last->stamp_ns);
  return dropouts;
}

bool is_gross(const Eigen::Vector3d& e_enu, const Eigen::Matrix3d& information) {
  static const double bound = chi_squared_quantile(1 - 1e-5, 3);
  return e_enu.dot(information * e_enu) > bound;
}

std::optional<FixDispersion> dispersion_of(const std::vector<FixResidual>& residuals,
                                           double max_gap_s) {
  std::vector<double> horizontal, vertical;
  for (std::size_t i = 1; i < residuals.size(); ++i) {
    const FixResidual &a = residuals[i - 1], &b = residuals[i];
    if (1e-9 * static_cast<double>(b.stamp_ns - a.stamp_ns) > max_gap_s) continue;
    const Eigen::Vector3d d = (b.e_enu - a.e_enu) / std::hypot(a.accuracy_m, b.accuracy_m);
    horizontal.push_back(std::abs(d[0]));
    horizontal.push_back(std::abs(d[1]));
    vertical.push_back(std::abs(d[2]));
  }
  if (vertical.size() < kLeastPairs) return std::nullopt;
  return FixDispersion{std::max(1.0, median_of(horizontal) / kMedianOfNormal),
                       std::max(1.0, median_of(vertical) / kMedianOfNormal)};
}

Eigen::Matrix3d fix_information(double horizontal, double vertical) {
  return Eigen::Vector3d(1 / (horizontal * horizontal), 1 / (horizontal * horizontal),
                         1 / (vertical * vertical))
      .asDiagonal();
}

}  // namespace placegraph
