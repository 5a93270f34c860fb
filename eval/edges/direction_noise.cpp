#include <placegraph/eval/edges/direction_noise.h>
#include <placegraph/graph/core/median.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace placegraph {
namespace {

constexpr double kVehiclePath = 20;                           // [m]
constexpr double kVehicleAngle = 3 * std::numbers::pi / 180;  // to the direction in which it moves
constexpr double kShortStep = 0.2;  // relative to the long ones: without a direction

/// The middle direction of motion in the body's frame; zero if there is none.
Eigen::Vector3d middle_direction(const std::vector<Eigen::Vector3d>& directions) {
  Eigen::Vector3d middle;
  for (int k = 0; k < 3; ++k) {
    std::vector<double> values;
    for (const Eigen::Vector3d& direction : directions) values.push_back(direction[k]);
    middle[k] = median_of(values);
  }
  return middle.norm() > 0.5 ? Eigen::Vector3d(middle.normalized()) : Eigen::Vector3d::Zero();
}

/// Angles y less the a + b x that fits most of those of `used`.
std::vector<double> residuals_of_line(const std::vector<double>& x, const std::vector<double>& y,
                                      const std::vector<bool>& used) {
  const std::size_t count = x.size();
  std::vector<double> residuals = y;
  double scale = 0;
  for (int iteration = 0; iteration < 30; ++iteration) {
    Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    for (std::size_t i = 0; i < count; ++i) {
      if (!used[i]) continue;
      const double far = scale > 0 ? std::abs(residuals[i]) / (1.345 * scale) : 0;  // Huber 1981
      const Eigen::Vector2d row(1, x[i]);
      normal += row * row.transpose() / std::max(1.0, far);
      right += row * y[i] / std::max(1.0, far);
    }
    const Eigen::Vector2d line = normal.completeOrthogonalDecomposition().solve(right);
    std::vector<double> sizes;
    for (std::size_t i = 0; i < count; ++i) {
      residuals[i] = y[i] - line[0] - line[1] * x[i];
      if (used[i]) sizes.push_back(std::abs(residuals[i]));
    }
    scale = 1.4826 * median_of(sizes);
  }
  return residuals;
}

/// Root mean square of the residuals over stretches of `frames` used steps, weighted by the steps'
/// lengths, beyond what ends with white noise of `sigma` explain; negative without a stretch.
double rms_over(int frames, const std::vector<double>& residuals,
                const std::vector<double>& lengths, const std::vector<bool>& used, double sigma) {
  const int count = static_cast<int>(used.size());
  double squares = 0, across = 0, along = 0;
  int run = 0, stretches = 0;
  for (int i = 0; i < count; ++i) {
    if (!used[i]) {
      run = 0, across = 0, along = 0;
      continue;
    }
    across += residuals[i] * lengths[i], along += lengths[i];
    if (++run > frames) {
      across -= residuals[i - frames] * lengths[i - frames];
      along -= lengths[i - frames];
    }
    if (run < frames) continue;
    squares += (across * across - 2 * sigma * sigma) / (along * along);
    ++stretches;
  }
  return stretches > 0 ? std::sqrt(std::max(0.0, squares / stretches)) : -1;
}

/// The steps of a vehicle, as angles of their direction.
struct Directions {
  std::vector<double> lengths, lateral, vertical, yaw, pitch;
  std::vector<bool> used;
};

Directions directions_of(const TruthSteps& truth, const TruthNoise& noise,
                         const Eigen::Vector3d& forward, const std::vector<bool>& used) {
  Directions result;
  result.used = used;
  for (int i = 0; i < truth.count(); ++i) {
    const Eigen::Vector3d t = truth.steps[i].head<3>(), rotation = truth.steps[i].tail<3>();
    const double length = std::max(t.norm(), kShortStep * truth.long_step_m);
    result.lengths.push_back(length);
    const double ahead = t.dot(forward);
    result.lateral.push_back(std::atan2(t.dot(noise.vertical_about), ahead));
    result.vertical.push_back(std::atan2(t.dot(noise.lateral_about), ahead));
    result.yaw.push_back(rotation.dot(noise.lateral_about) / length);
    result.pitch.push_back(rotation.dot(noise.vertical_about) / length);
  }
  return result;
}

/// Steps that are long enough for a direction and were measured.
std::vector<bool> directed_steps(const TruthSteps& truth, const TruthNoise& noise) {
  std::vector<bool> used;
  for (int i = 0; i < truth.count(); ++i)
    used.push_back(truth.known[i] &&
                   truth.steps[i].head<3>().norm() > kShortStep * truth.long_step_m &&
                   !noise.is_interpolated(i) && !noise.is_interpolated(i + 1));
  return used;
}

/// The direction in which a wheeled vehicle moves, in its body's frame; zero for other motions.
Eigen::Vector3d forward_of_vehicle(const TruthSteps& truth, const std::vector<bool>& used) {
  std::vector<Eigen::Vector3d> directions;
  double path = 0;
  for (int i = 0; i < truth.count(); ++i) {
    if (!used[i]) continue;
    directions.push_back(truth.steps[i].head<3>().normalized());
    path += truth.steps[i].head<3>().norm();
  }
  if (path < kVehiclePath || directions.size() < 20) return Eigen::Vector3d::Zero();
  const Eigen::Vector3d forward = middle_direction(directions);
  std::vector<double> angles;
  for (const Eigen::Vector3d& direction : directions)
    angles.push_back(std::atan2(direction.cross(forward).norm(), direction.dot(forward)));
  return median_of(angles) < kVehicleAngle ? forward : Eigen::Vector3d(Eigen::Vector3d::Zero());
}

}  // namespace

void estimate_direction_noise(const TruthSteps& truth, TruthNoise& noise) {
  const std::vector<bool> used = directed_steps(truth, noise);
  const Eigen::Vector3d forward = forward_of_vehicle(truth, used);
  if (forward.isZero()) return;
  // The lateral direction errs about what is nearest to the camera's y axis.
  const Eigen::Vector3d down = Eigen::Vector3d::UnitY() - forward.y() * forward;
  noise.lateral_about =
      down.norm() > 0.5 ? Eigen::Vector3d(down.normalized()) : forward.unitOrthogonal();
  noise.vertical_about = noise.lateral_about.cross(forward);
  const Directions d = directions_of(truth, noise, forward, used);
  const std::vector<double> lateral = residuals_of_line(d.yaw, d.lateral, used),
                            vertical = residuals_of_line(d.pitch, d.vertical, used);
  const double sigma_lateral = noise.sigma.head<3>().cwiseProduct(noise.vertical_about).norm(),
               sigma_vertical = noise.sigma.head<3>().cwiseProduct(noise.lateral_about).norm();
  for (int frames = 1; frames <= 128; frames *= 2) {
    const double across = rms_over(frames, lateral, d.lengths, used, sigma_lateral);
    if (across < 0) break;
    noise.direction.push_back(
        {frames, across, rms_over(frames, vertical, d.lengths, used, sigma_vertical)});
  }
}

}  // namespace placegraph
