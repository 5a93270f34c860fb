#include <fmt/format.h>
#include <placegraph/eval/info/likely_conventions.h>
#include <placegraph/eval/info/motion_axes.h>
#include <placegraph/graph/measurements/stamp_plausibility.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

using Quaternion = Eigen::Quaterniond;

// Directions of which 90 % agree in one order and less than 70 % in the others. Chosen.
constexpr double kSteadyOrder = 0.9, kUnsteadyOrder = 0.7;
constexpr double kIdentity = 1e-6;  // digits of a file
// Speeds of what people evaluate, from a crawling robot to an airliner. Chosen.
constexpr double kSlowest_m_per_s = 1e-3, kFastest_m_per_s = 300;
constexpr double kMetresPerDegree = 111'000;  // of latitude
constexpr double kLeastDegreesFromZero = 1;   // a place on the earth is rarely nearer to (0, 0)

/// An order of the numbers of a quaternion in a file.
struct QuaternionOrder {
  const char* name;
  Quaternion (*turned)(const Quaternion&);  ///< the orientation, from the one that was read
  bool as_read;
};

const QuaternionOrder kOrders[] = {
    {"as read", [](const Quaternion& q) { return q; }, true},
    {"w first, although read as w last",
     [](const Quaternion& q) { return Quaternion(q.x(), q.y(), q.z(), q.w()); }, false},
    {"w last, although read as w first",
     [](const Quaternion& q) { return Quaternion(q.z(), q.w(), q.x(), q.y()); }, false}};

bool is_identity(const Quaternion& q) { return 1 - std::abs(q.w()) < kIdentity; }

/// The order in which the first pose is the identity, at the origin; nullptr without one.
const QuaternionOrder* order_from_origin(const PosedFrames& frames) {
  if (frames.p_world.front().norm() > kIdentity) return nullptr;
  for (const QuaternionOrder& order : kOrders)
    if (is_identity(order.turned(frames.q_world_body.front()))) return &order;
  return nullptr;
}

Likelihood not_evident(std::string reason) {
  Likelihood likelihood;
  likelihood.outcome = Outcome::failure(Outcome::Code::kDegenerate, std::move(reason));
  return likelihood;
}

/// The largest coordinate, and the extent, of one axis.
struct AxisRange {
  double least = 0, greatest = 0;
  double extent() const { return greatest - least; }
  double nearest_to_zero() const {
    return least <= 0 && greatest >= 0 ? 0 : std::min(std::abs(least), std::abs(greatest));
  }
};

AxisRange range_along(const PosedFrames& frames, int axis) {
  const auto [least, greatest] = std::ranges::minmax_element(
      frames.p_world, {}, [axis](const Eigen::Vector3d& p) { return p[axis]; });
  return {(*least)[axis], (*greatest)[axis]};
}

/// Latitude and longitude: two coordinates in their ranges, away from zero, that hardly change.
bool may_be_degrees(const PosedFrames& frames) {
  const AxisRange x = range_along(frames, 0), y = range_along(frames, 1);
  const auto within = [](const AxisRange& axis, double most) {
    return axis.least >= -most && axis.greatest <= most;
  };
  const bool in_ranges =
      within(x, 180) && within(y, 180) && (within(x, 90) || within(y, 90));
  return in_ranges && x.nearest_to_zero() > kLeastDegreesFromZero &&
         y.nearest_to_zero() > kLeastDegreesFromZero && std::max(x.extent(), y.extent()) < 1;
}

/// The usual speed in the plane of x and y, in units per second; the median of steps.
double speed_in_plane(const PosedFrames& frames) {
  std::vector<double> speeds;
  for (const MotionOver& motion : motions_over(frames, 1))
    speeds.push_back(
        (frames.p_world[motion.to] - frames.p_world[motion.from]).head<2>().norm() / motion.time);
  return spread_of(std::move(speeds)).median;
}

}  // namespace

Likelihood likely_quaternions(const PosedFrames& frames) {
  if (!frames.has_orientation || frames.size() == 0)
    return not_evident("there are no orientations");
  double steadiness[std::size(kOrders)] = {};
  for (std::size_t i = 0; i < std::size(kOrders); ++i)
    if (const auto mean = mean_direction_body(frames, kOrders[i].turned))
      steadiness[i] = mean->norm();
  const auto best = static_cast<std::size_t>(std::max_element(std::begin(steadiness),
                                                              std::end(steadiness)) -
                                             std::begin(steadiness));
  double others = 0;
  for (std::size_t i = 0; i < std::size(kOrders); ++i)
    if (i != best) others = std::max(others, steadiness[i]);
  Likelihood likelihood;
  likelihood.outcome = Outcome::ok();
  if (steadiness[best] >= kSteadyOrder && others < kUnsteadyOrder) {
    likelihood.as_read = kOrders[best].as_read;
    likelihood.answer = fmt::format(
        "{}: only so the body moves along one of its directions ({:.0f} % agree, in another order "
        "{:.0f} %)",
        kOrders[best].name, 100 * steadiness[best], 100 * others);
    return likelihood;
  }
  if (const QuaternionOrder* order = order_from_origin(frames)) {
    likelihood.as_read = order->as_read;
    likelihood.answer = std::string(order->name) + ": only so the first pose is the identity";
    return likelihood;
  }
  return not_evident("the motion fits more than one order");
}

Likelihood likely_length_unit(const PosedFrames& frames, const Spread& speed) {
  if (!frames.has_times) return not_evident("without times there are no speeds");
  if (speed.count == 0 || !(speed.p95 > 0)) return not_evident("the body does not move");
  Likelihood likelihood;
  likelihood.outcome = Outcome::ok();
  const double degrees_as_m_per_s = speed_in_plane(frames) * kMetresPerDegree;
  if (may_be_degrees(frames) && speed.median < kSlowest_m_per_s &&
      degrees_as_m_per_s > kSlowest_m_per_s && degrees_as_m_per_s < kFastest_m_per_s) {
    likelihood.as_read = false;
    likelihood.answer = fmt::format(
        "degrees of latitude and longitude in x and y: as metres the speed is {:.2g} m/s, as "
        "degrees {:.2g} m/s",
        speed.median, degrees_as_m_per_s);
    return likelihood;
  }
  if (speed.median > kFastest_m_per_s) {
    likelihood.as_read = false;
    likelihood.answer = fmt::format(
        "no metres, but millimetres or the like: as metres the usual speed is {:.3g} m/s",
        speed.median);
    return likelihood;
  }
  if (speed.p95 < kSlowest_m_per_s)
    return not_evident(
        fmt::format("as metres the body is very slow, at most {:.2g} m/s", speed.p95));
  likelihood.answer = fmt::format("metres are plausible: usually {:.3g} m/s", speed.median);
  return likelihood;
}

Likelihood likely_time_unit(const PosedFrames& frames) {
  if (!frames.has_times) return not_evident("there are no times");
  if (frames.size() < 2) return not_evident("there are fewer than two poses");
  const std::string odd = odd_spacing(frames.stamps_ns, "pose");
  Likelihood likelihood;
  likelihood.outcome = Outcome::ok();
  likelihood.as_read = odd.empty();
  likelihood.answer = odd.empty() ? "plausible as read" : "not as read: " + odd;
  return likelihood;
}

}  // namespace placegraph
