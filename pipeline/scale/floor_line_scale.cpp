#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/median.h>
#include <placegraph/pipeline/scale/floor_line_scale.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

/// Maximum distance of a used scale from the median of the last five (logarithm). Chosen; as for
/// the ground plane.
constexpr double kMaxFloorLogJump = 0.12;

}  // namespace

FloorLineScale::FloorLineScale(const FloorLineScaleOptions& options, const Camera& camera,
                               double camera_height_m)
    : options_(options), camera_(camera), camera_height_m_(camera_height_m) {
  options_.check();
  require(camera_height_m > 0, "camera_height_m: must be positive");
}

void FloorLineScale::reset() {
  used_.clear();
  recent_log_factors_.clear();
  first_log_factors_.clear();
}

/// The scale once the last views agree on it: their median over three views.
std::optional<GroundPlaneScale::ScaleMeasurement> FloorLineScale::agreed(double log_factor,
                                                                         double sigma) {
  // Chosen: the median survives one outlier.
  constexpr std::size_t kViews = 3;
  first_log_factors_.push_back(log_factor);
  if (first_log_factors_.size() > kViews) first_log_factors_.pop_front();
  if (first_log_factors_.size() < kViews) return std::nullopt;
  const auto [least, most] =
      std::minmax_element(first_log_factors_.begin(), first_log_factors_.end());
  if (*most - *least > 2 * options_.max_sigma_at_first) return std::nullopt;
  return GroundPlaneScale::ScaleMeasurement{
      std::exp(median_of({first_log_factors_.begin(), first_log_factors_.end()})), sigma};
}

std::optional<GroundPlaneScale::ScaleMeasurement> FloorLineScale::measure(
    const SE3& T_odom_cam, const std::vector<PlacedLine>& lines,
    const std::vector<SharedDirection>& shared, bool scale_known) {
  const FloorFromLines floor = floor_from_lines(camera_, T_odom_cam, lines, options_.floor, shared);
  if (!floor.outcome) return std::nullopt;
  const double log_factor = std::log(camera_height_m_ / floor.height);
  double sigma = std::hypot(floor.sigma_height / floor.height, options_.sigma_relative);
  if (!scale_known) {
    if (sigma > options_.max_sigma_at_first) return std::nullopt;
    return agreed(log_factor, sigma);
  }
  // Shelves occlude the floor for a short time only.
  constexpr std::size_t kMemory = 5;
  double expected = 0;
  if (recent_log_factors_.size() >= 3)
    expected = median_of({recent_log_factors_.begin(), recent_log_factors_.end()});
  recent_log_factors_.push_back(log_factor);
  if (recent_log_factors_.size() > kMemory) recent_log_factors_.pop_front();
  if (std::abs(log_factor - expected) > kMaxFloorLogJump) return std::nullopt;
  int fresh = 0;
  for (const LineId id : floor.on_floor) fresh += used_.insert(id).second;
  if (fresh == 0) return std::nullopt;
  sigma *= std::sqrt(static_cast<double>(floor.on_floor.size()) / fresh);
  return GroundPlaneScale::ScaleMeasurement{std::exp(log_factor), sigma};
}

}  // namespace placegraph
