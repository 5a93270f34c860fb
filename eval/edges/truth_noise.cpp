#include <placegraph/eval/edges/direction_noise.h>
#include <placegraph/eval/edges/truth_noise.h>
#include <placegraph/graph/core/chi_squared.h>
#include <placegraph/graph/core/median.h>
#include <placegraph/graph/core/quantile.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace placegraph {
namespace {

constexpr std::array<double, 5> kDifference = {1, -4, 6, -4, 1};   // fourth order, for positions
constexpr std::array<double, 4> kStepDifference = {-1, 3, -3, 1};  // the same, of relative poses
constexpr double kSquaresOfDifference = 70;  // sum over the coefficients of the first
constexpr int kPosesOfDifference = static_cast<int>(kDifference.size());
// Chosen.
constexpr int kDifferencesOfWindow = 16;
constexpr int kPosesOfWindow = kDifferencesOfWindow + kPosesOfDifference - 1;

/// Fourth differences about a frame and the three behind it, over white noise of unit size; nothing
/// where a pose is missing.
std::optional<Vector6d> difference_at(const TruthSteps& truth, int frame) {
  Eigen::Vector3d position = Eigen::Vector3d::Zero(), rotation = Eigen::Vector3d::Zero();
  for (int k = 0; k < kPosesOfDifference; ++k) {
    if (!truth.poses[frame + k]) return std::nullopt;
    position += kDifference[k] * truth.poses[frame + k]->translation();
    if (k + 1 < kPosesOfDifference)
      rotation += kStepDifference[k] * truth.steps[frame + k].tail<3>();
  }
  Vector6d difference;
  difference << truth.poses[frame + 2]->rotation().inverse() * position, rotation;
  return difference / std::sqrt(kSquaresOfDifference);
}

/// Lower quartile of the mean square of a window's differences of white noise of unit size. Fourth
/// differences at distance 1 to 4 are correlated.
double quartile_of_window() {
  // Products of the coefficients of fourth differences, over their squares, 70.
  constexpr std::array<double, 4> kCorrelation = {-56. / 70, 28. / 70, -8. / 70, 1. / 70};
  double sum = kDifferencesOfWindow;
  for (int k = 1; k <= 4; ++k)
    sum += 2 * (kDifferencesOfWindow - k) * kCorrelation[k - 1] * kCorrelation[k - 1];
  return mean_square_quantile(-0.67449, kDifferencesOfWindow * kDifferencesOfWindow / sum);
}

/// Mean squares of the differences of every window of frames that all fit.
std::vector<Vector6d> windows_of(const std::vector<std::optional<Vector6d>>& differences,
                                 const std::vector<bool>& fits) {
  std::vector<Vector6d> windows;
  const int count = static_cast<int>(differences.size());
  for (int first = 0; first + kDifferencesOfWindow <= count; ++first) {
    if (!std::all_of(fits.begin() + first, fits.begin() + first + kPosesOfWindow,
                     [](bool fit) { return fit; }))
      continue;
    Vector6d squares = Vector6d::Zero();
    for (int i = first; i < first + kDifferencesOfWindow; ++i)
      squares += differences[i]->cwiseAbs2() / kDifferencesOfWindow;
    windows.push_back(squares);
  }
  return windows;
}

std::vector<std::optional<Vector6d>> differences_of(const TruthSteps& truth) {
  std::vector<std::optional<Vector6d>> differences;
  for (int i = 0; i + kPosesOfDifference <= static_cast<int>(truth.poses.size()); ++i)
    differences.push_back(difference_at(truth, i));
  return differences;
}

/// How much the rotation changes from step i to the next; negative where it is not known or the
/// body stands.
std::vector<double> changes_of_rotation(const TruthSteps& truth) {
  std::vector<double> changes;
  for (int i = 0; i + 1 < truth.count(); ++i) {
    const bool both = truth.moves[i] && truth.moves[i + 1];
    changes.push_back(both ? (truth.steps[i + 1] - truth.steps[i]).tail<3>().norm() : -1);
  }
  return changes;
}

/// The usual change of rotation, if it is noise that makes it: otherwise interpolated poses look
/// like smooth motion.
std::optional<double> usual_change(const std::vector<double>& changes,
                                   const std::vector<std::optional<Vector6d>>& differences) {
  std::vector<double> usual, noise;
  for (const double change : changes)
    if (change >= 0) usual.push_back(change);
  for (const auto& difference : differences)
    if (difference) noise.push_back(difference->tail<3>().norm());
  if (usual.empty() || noise.empty()) return std::nullopt;
  // White noise changes the rotation by sqrt(6) times its size.
  const double change = median_of(usual), by_noise = std::sqrt(6) * median_of(noise);
  if (!(by_noise > 0.1 * change)) return std::nullopt;
  return change;
}

std::vector<FrameStretch> interpolated_stretches(
    const TruthSteps& truth, const std::vector<std::optional<Vector6d>>& differences) {
  constexpr double kEven = 0.02;  // relative to the usual change
  constexpr int kFewest = 4;      // changes, between five steps
  std::vector<FrameStretch> stretches;
  const std::vector<double> changes = changes_of_rotation(truth);
  const auto usual = usual_change(changes, differences);
  if (!usual) return stretches;
  const auto even = [&](int i) { return changes[i] >= 0 && changes[i] < kEven * *usual; };
  const int count = static_cast<int>(changes.size());
  for (int first = 0, last; first < count; first = last + 1) {
    for (last = first; last < count && even(last); ++last) {
    }
    if (last - first >= kFewest) stretches.push_back({first, last + 1});
  }
  return stretches;
}

}  // namespace

TruthNoise TruthNoise::white(double position_m, double rotation_rad) {
  TruthNoise noise;
  noise.sigma.head<3>().setConstant(position_m);
  noise.sigma.tail<3>().setConstant(rotation_rad);
  return noise;
}

bool TruthNoise::is_interpolated(int frame) const {
  return std::any_of(interpolated.begin(), interpolated.end(), [&](const FrameStretch& stretch) {
    return stretch.first <= frame && frame <= stretch.last;
  });
}

Matrix6d TruthNoise::covariance(const SE3& T_from_to, int frames) const {
  const Matrix6d white = sigma.cwiseAbs2().asDiagonal();
  const Matrix6d to_from = T_from_to.inverse().adjoint();
  Matrix6d result = to_from * white * to_from.transpose() + white;
  if (direction.empty()) return result;
  // The entry of the most frames that are not more than those between the two poses.
  const auto beyond =
      std::find_if(direction.begin() + 1, direction.end(),
                   [&](const DirectionNoise& d) { return d.frames > std::abs(frames); });
  const DirectionNoise& noise = *(beyond - 1);
  // A small rotation w of the body moves the end by w x t.
  const Eigen::Matrix3d R_to_from = T_from_to.rotation().inverse().matrix();
  const Eigen::Vector3d t = T_from_to.translation();
  for (const Eigen::Vector3d& rotation : {Eigen::Vector3d(noise.lateral_rad * lateral_about),
                                          Eigen::Vector3d(noise.vertical_rad * vertical_about)}) {
    const Eigen::Vector3d shift = R_to_from * rotation.cross(t);
    result.topLeftCorner<3, 3>() += shift * shift.transpose();
  }
  return result;
}

TruthNoise estimate_truth_noise(const Trajectory& trajectory) {
  const TruthSteps truth(trajectory);
  const auto differences = differences_of(truth);
  TruthNoise noise;
  noise.interpolated = interpolated_stretches(truth, differences);
  std::vector<bool> fits;
  for (int i = 0; i < static_cast<int>(truth.poses.size()); ++i)
    fits.push_back(truth.poses[i] && !noise.is_interpolated(i) &&
                   (i == truth.count() || truth.moves[i]));
  const auto windows = windows_of(differences, fits);
  if (windows.empty()) {
    noise.outcome = Outcome::failure(Outcome::Code::kTooFewData,
                                     "the truth has no " + std::to_string(kPosesOfWindow) +
                                         " measured poses in a row that move, from which its noise "
                                         "could be estimated");
    return noise;
  }
  for (int k = 0; k < 6; ++k) {
    std::vector<double> squares;
    for (const Vector6d& window : windows) squares.push_back(window[k]);
    noise.sigma[k] = std::sqrt(quantile_of(squares, 0.25) / quartile_of_window());
  }
  estimate_direction_noise(truth, noise);
  return noise;
}

}  // namespace placegraph
