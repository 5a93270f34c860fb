#include "apps/flight/flight_map_report.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <numbers>

namespace placegraph::apps {
namespace {

using nlohmann::json;

constexpr double kDeg = 180 / std::numbers::pi;

const PlacedMarker* find(const MarkerLayout& layout, int id) {
  const auto at = std::find_if(layout.markers.begin(), layout.markers.end(),
                               [id](const PlacedMarker& marker) { return marker.id == id; });
  return at == layout.markers.end() ? nullptr : &*at;
}

}  // namespace

json describe_marker_map(const MarkerMap& map, const MarkerLayout& known,
                         const MarkerLayout& truth) {
  if (!map.outcome) return {{"refused", map.outcome.reason}};
  json markers = json::array();
  double worst_m = 0, worst_deg = 0, nees = 0;
  int compared = 0;
  for (const MappedMarker& mapped : map.markers) {
    const int id = mapped.marker.id;
    if (find(known, id)) continue;
    const SE3& T = mapped.marker.T_world_marker;
    json one{{"id", id},
             {"views", mapped.views},
             {"position", {T.translation().x(), T.translation().y(), T.translation().z()}},
             {"sigma_position_m", std::sqrt(mapped.covariance.topLeftCorner<3, 3>().trace())},
             {"sigma_attitude_deg",
              kDeg * std::sqrt(mapped.covariance.bottomRightCorner<3, 3>().trace())}};
    if (const PlacedMarker* at = find(truth, id)) {
      const Vector6d off = (T.inverse() * at->T_world_marker).log();
      const double error_m = (at->T_world_marker.translation() - T.translation()).norm();
      const double error_deg = kDeg * off.tail<3>().norm();
      one["error_m"] = error_m;
      one["error_deg"] = error_deg;
      worst_m = std::max(worst_m, error_m);
      worst_deg = std::max(worst_deg, error_deg);
      nees += off.dot(mapped.covariance.ldlt().solve(off)) / 6;
      ++compared;
    }
    markers.push_back(one);
  }
  json described{{"markers", markers}};
  if (compared > 0) {
    described["compared_markers"] = compared;
    described["worst_error_m"] = worst_m;
    described["worst_error_deg"] = worst_deg;
    described["nees_per_dof"] = nees / compared;
  }
  return described;
}

MarkerLayout with_mapped(const MarkerLayout& known, const MarkerMap& map) {
  MarkerLayout layout = known;
  for (const MappedMarker& mapped : map.markers)
    if (layout.unplaced_sides_m.erase(mapped.marker.id) > 0)
      layout.markers.push_back(mapped.marker);
  return layout;
}

std::string marker_map_line(const json& described) {
  if (described.contains("refused"))
    return "no marker mapped: " + described["refused"].get<std::string>();
  std::string line = fmt::format("{} markers mapped", described["markers"].size());
  if (described.contains("compared_markers"))
    line += fmt::format(
        ", {} compared: off by {:.4f} m and {:.2f} deg at worst, NEES {:.2f}",
        described["compared_markers"].get<int>(), described["worst_error_m"].get<double>(),
        described["worst_error_deg"].get<double>(), described["nees_per_dof"].get<double>());
  return line;
}

}  // namespace placegraph::apps
