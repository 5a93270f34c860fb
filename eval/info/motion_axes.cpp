#include <fmt/format.h>
#include <placegraph/eval/info/motion_axes.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/quantile.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

// Shares of an extent below which positions are on a line or in a plane. Chosen.
constexpr double kLineShare = 1e-2, kPlaneShare = 5e-2;
// The turns have one axis if the others have less than a tenth of the squared angles; it agrees
// with the normal of a plane within 20 degrees. Chosen.
constexpr double kOneAxisShare = 0.9, kSameAxis_deg = 20;
constexpr double kLeastTurn_deg = 30;  // of all turns together: less is noise or a straight drive
// Directions of steps as long as a tenth of the longest ones are more than noise. Chosen.
constexpr double kLongStepShare = 0.1, kLongStep = 0.95;
constexpr std::size_t kFewestDirections = 10;
constexpr double kSteady = 0.8, kNearAxis_deg = 30;
constexpr double kDirectionOver_s = 0.1;

constexpr const char* kAxisNames = "xyz";

/// The angle between two lines [deg].
double angle_between_lines_deg(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return rad_to_deg(std::atan2(a.cross(b).norm(), std::abs(a.dot(b))));
}

/// The axis of the world about which the body turns; nothing if it hardly turns or about several.
std::optional<Eigen::Vector3d> turning_axis(const PosedFrames& frames) {
  if (!frames.has_orientation) return std::nullopt;
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  double sum_deg = 0;
  for (const MotionOver& motion : motions_over(frames, frames.has_times ? kDirectionOver_s : 1)) {
    const Eigen::Quaterniond &a = frames.q_world_body[motion.from],
                             &b = frames.q_world_body[motion.to];
    const Eigen::AngleAxisd turn(b * a.conjugate());
    squares += turn.angle() * turn.angle() * turn.axis() * turn.axis().transpose();
    sum_deg += rad_to_deg(turn.angle());
  }
  if (sum_deg < kLeastTurn_deg) return std::nullopt;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> parts(squares);
  if (parts.eigenvalues()[2] < kOneAxisShare * squares.trace()) return std::nullopt;
  return parts.eigenvectors().col(2);
}

/// From the first position, so that positions that are all equal have no deviation at all.
Eigen::Vector3d mean_of(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) sum += p - points.front();
  return points.front() + sum / static_cast<double>(points.size());
}

/// The axes of positions by columns, from that of the least extent to that of the greatest.
Eigen::Matrix3d principal_axes(const std::vector<Eigen::Vector3d>& points) {
  const Eigen::Vector3d mean = mean_of(points);
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p : points) squares += (p - mean) * (p - mean).transpose();
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(squares).eigenvectors();
}

/// Standard deviations of positions along axes.
Eigen::Vector3d rms_along(const Eigen::Matrix3d& axes, const std::vector<Eigen::Vector3d>& points) {
  const Eigen::Vector3d mean = mean_of(points);
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points)
    squares += (axes.transpose() * (p - mean)).cwiseAbs2();
  return (squares / static_cast<double>(points.size())).cwiseSqrt();
}

std::string convention_of(const std::string& axis) {
  if (axis == "+z") return "a camera (x right, y down, z forward)";
  if (axis == "-z") return "a camera of OpenGL (x right, y up, z back)";
  if (axis == "+x") return "a vehicle (x forward)";
  if (axis == "+y") return "a vehicle with y forward";
  return {};
}

Eigen::Quaterniond unturned(const Eigen::Quaterniond& q) { return q; }

}  // namespace

MotionPlane motion_plane(const PosedFrames& frames) {
  MotionPlane plane;
  if (frames.size() < 3) {
    plane.outcome = Outcome::failure(Outcome::Code::kTooFewData, "fewer than 3 poses");
    return plane;
  }
  const Eigen::Matrix3d axes = principal_axes(frames.p_world);
  // Along the axes themselves: the root of an eigenvalue has half of its digits.
  const Eigen::Vector3d rms = rms_along(axes, frames.p_world);
  plane.normal_world = axes.col(0);
  plane.rms_m = rms[0];
  plane.share = rms[1] > 0 ? rms[0] / rms[1] : 1;
  Eigen::Index axis = 0;
  plane.normal_world.cwiseAbs().maxCoeff(&axis);
  plane.axis = kAxisNames[axis];
  plane.tilt_deg = angle_between_lines_deg(plane.normal_world, Eigen::Vector3d::Unit(axis));
  using Code = Outcome::Code;
  if (!(rms[2] > 0)) {
    plane.outcome = Outcome::failure(Code::kDegenerate, "the body does not move");
  } else if (rms[1] < kLineShare * rms[2]) {
    plane.outcome = Outcome::failure(
        Code::kDegenerate,
        fmt::format("the path is a straight line ({:.2g} % off it)", 100 * rms[1] / rms[2]));
  } else if (plane.share > kPlaneShare) {
    plane.outcome = Outcome::failure(
        Code::kDegenerate, fmt::format("the path is in no plane (off it by {:.2g} % of its "
                                       "shorter extent)",
                                       100 * plane.share));
  } else if (const auto turns = turning_axis(frames)) {
    const double apart_deg = angle_between_lines_deg(*turns, plane.normal_world);
    plane.outcome =
        apart_deg <= kSameAxis_deg
            ? Outcome::ok()
            : Outcome::failure(Code::kInconsistent,
                               fmt::format("positions are in a plane, but the body turns about an "
                                           "axis {:.0f} deg from its normal",
                                           apart_deg));
  } else {
    plane.outcome = Outcome::ok();
  }
  return plane;
}

std::optional<Eigen::Vector3d> mean_direction_body(
    const PosedFrames& frames, Eigen::Quaterniond (*turned)(const Eigen::Quaterniond&)) {
  const std::vector<MotionOver> motions =
      motions_over(frames, frames.has_times ? kDirectionOver_s : 1);
  std::vector<double> lengths;
  for (const MotionOver& motion : motions)
    lengths.push_back(frames.distance_m(motion.from, motion.to));
  if (lengths.empty()) return std::nullopt;
  const double least = kLongStepShare * quantile_of(lengths, kLongStep);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  std::size_t count = 0;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    if (!(lengths[i] > least)) continue;
    const MotionOver& motion = motions[i];
    // The body's axes half way: their rotation moves it to neither side.
    const Eigen::Quaterniond q = turned(frames.q_world_body[motion.from])
                                     .slerp(0.5, turned(frames.q_world_body[motion.to]));
    sum += q.conjugate() * (frames.p_world[motion.to] - frames.p_world[motion.from]).normalized();
    ++count;
  }
  if (count < kFewestDirections) return std::nullopt;
  return sum / static_cast<double>(count);
}

ForwardAxis forward_axis(const PosedFrames& frames) {
  ForwardAxis forward;
  using Code = Outcome::Code;
  if (!frames.has_orientation) {
    forward.outcome = Outcome::failure(Code::kTooFewData, "positions alone have no axes");
    return forward;
  }
  const std::optional<Eigen::Vector3d> mean = mean_direction_body(frames, unturned);
  if (!mean) {
    forward.outcome = Outcome::failure(Code::kTooFewData, "the body moves in fewer than 10 steps");
    return forward;
  }
  forward.steadiness = mean->norm();
  forward.direction_body = mean->normalized();
  Eigen::Index axis = 0;
  forward.direction_body.cwiseAbs().maxCoeff(&axis);
  forward.axis = std::string(forward.direction_body[axis] < 0 ? "-" : "+") + kAxisNames[axis];
  forward.angle_deg =
      rad_to_deg(std::acos(std::min(1.0, std::abs(forward.direction_body[axis]))));
  forward.convention = convention_of(forward.axis);
  if (forward.steadiness < kSteady)
    forward.outcome = Outcome::failure(
        Code::kDegenerate, fmt::format("the body moves along changing directions of its own "
                                       "({:.0f} % agree)",
                                       100 * forward.steadiness));
  else if (forward.angle_deg > kNearAxis_deg)
    forward.outcome = Outcome::failure(
        Code::kDegenerate, fmt::format("the body moves along no axis of its own: {:.0f} deg from "
                                       "{}",
                                       forward.angle_deg, forward.axis));
  else
    forward.outcome = Outcome::ok();
  return forward;
}

}  // namespace placegraph
