#include <placegraph/frontend/floor_plan/building_axes.h>
#include <placegraph/graph/core/angle.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace placegraph {
namespace {

constexpr std::size_t kFewest = 50;  ///< least number of points of a direction

/// Direction that normals near `guess` or opposite to it share: a mean with narrowing limits.
Eigen::Vector3d shared_direction(const std::vector<SurfacePoint>& points,
                                 const Eigen::Vector3d& guess, std::size_t& count) {
  Eigen::Vector3d direction = guess.normalized();
  for (const double reach_deg : {30.0, 15.0, 8.0, 5.0, 5.0, 5.0}) {
    const double least = std::cos(deg_to_rad(reach_deg));
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    count = 0;
    for (const SurfacePoint& point : points) {
      const Eigen::Vector3d n = point.normal.cast<double>();
      const double cosine = n.dot(direction);
      if (std::abs(cosine) < least) continue;
      sum += cosine > 0 ? n : Eigen::Vector3d(-n);
      ++count;
    }
    if (count < kFewest) return direction;
    direction = sum.normalized();
  }
  return direction;
}

/// Lowest level with a fifth as many points as the fullest one, of those observed from above.
std::optional<double> floor_level(const std::vector<std::pair<double, double>>& levels) {
  // A cell of the plan. Chosen.
  constexpr double kBin_m = 0.05;
  if (levels.size() < kFewest) return std::nullopt;
  double low = 1e9, high = -1e9;
  for (const auto& [height, sigma] : levels)
    low = std::min(low, height), high = std::max(high, height);
  std::vector<double> histogram(static_cast<std::size_t>((high - low) / kBin_m) + 3, 0.0);
  for (const auto& [height, sigma] : levels)
    histogram[static_cast<std::size_t>((height - low) / kBin_m)] += 1;
  std::vector<double> smooth(histogram.size(), 0.0);
  for (std::size_t i = 0; i < histogram.size(); ++i)
    for (std::size_t j = i > 0 ? i - 1 : 0; j < std::min(histogram.size(), i + 2); ++j)
      smooth[i] += histogram[j];
  const double most = *std::max_element(smooth.begin(), smooth.end());
  std::size_t best = 0;
  while (smooth[best] < 0.2 * most) ++best;
  while (best + 1 < smooth.size() && smooth[best + 1] > smooth[best]) ++best;
  const double middle = low + (static_cast<double>(best) + 0.5) * kBin_m;
  double sum = 0, weights = 0;
  for (const auto& [height, sigma] : levels) {
    if (std::abs(height - middle) > 1.5 * kBin_m) continue;
    const double weight = 1 / (1e-4 + sigma * sigma);
    sum += weight * height, weights += weight;
  }
  return sum / weights;
}

/// Rotation, modulo a right angle, that the level normals share; the fullest bin of a histogram,
/// refined.
std::optional<double> shared_rotation(const std::vector<double>& angles) {
  if (angles.size() < kFewest) return std::nullopt;
  // Half a degree each. Chosen.
  constexpr int kBins = 180;
  const double quarter = std::numbers::pi / 2;
  std::vector<int> histogram(kBins, 0);
  const auto wrap = [&](double a) { return a - quarter * std::floor(a / quarter); };
  for (const double a : angles)
    ++histogram[std::min(kBins - 1, static_cast<int>(wrap(a) / quarter * kBins))];
  int best = 0, most = -1;
  for (int i = 0; i < kBins; ++i) {
    int sum = 0;
    for (int j = -3; j <= 3; ++j) sum += histogram[(i + j + kBins) % kBins];
    if (sum > most) most = sum, best = i;
  }
  double rotation_rad = (best + 0.5) / kBins * quarter;
  for (const double reach : {3.0, 2.0, 1.5, 1.5}) {
    double sum = 0;
    int count = 0;
    for (const double a : angles) {
      const double d = std::remainder(a - rotation_rad, quarter);
      if (std::abs(d) > deg_to_rad(reach)) continue;
      sum += d, ++count;
    }
    if (count > 0) rotation_rad += sum / count;
  }
  return std::remainder(rotation_rad, quarter);
}

}  // namespace

BuildingAxes find_building_axes(const std::vector<SurfacePoint>& points_map,
                                const Eigen::Vector3d& up_guess) {
  BuildingAxes axes;
  const auto fail = [&](const char* reason) {
    axes.outcome = Outcome::failure(Outcome::Code::kDegenerate, reason);
    return axes;
  };
  std::size_t count = 0;
  const Eigen::Vector3d up = shared_direction(points_map, up_guess, count);
  if (count < kFewest) return fail("no level surface for the vertical");
  // x along the map's x, projected to the level plane.
  Eigen::Vector3d x = Eigen::Vector3d::UnitX() - up[0] * up;
  if (x.norm() < 0.3) x = Eigen::Vector3d::UnitZ() - up[2] * up;
  x.normalize();
  Eigen::Matrix3d R;
  R.row(0) = x, R.row(1) = up.cross(x), R.row(2) = up;
  std::vector<double> angles;
  std::vector<std::pair<double, double>> levels;
  for (const SurfacePoint& point : points_map) {
    if (point.normal.squaredNorm() < 0.5F) continue;
    const Eigen::Vector3d n = R * point.normal.cast<double>();
    if (std::abs(n[2]) < 0.1) angles.push_back(std::atan2(n[1], n[0]));
    if (n[2] > 0.95) levels.emplace_back(up.dot(point.point.cast<double>()), point.sigma);
  }
  const auto floor = floor_level(levels);
  if (!floor) return fail("no floor");
  const auto rotation_rad = shared_rotation(angles);
  if (!rotation_rad) return fail("no upright surface");
  Eigen::Matrix3d about_z = Eigen::Matrix3d::Identity();
  about_z.topLeftCorner<2, 2>() << std::cos(*rotation_rad), std::sin(*rotation_rad),
      -std::sin(*rotation_rad), std::cos(*rotation_rad);
  axes.T_walls_map = SE3(about_z * R, Eigen::Vector3d(0, 0, -*floor));
  axes.outcome = Outcome::ok();
  return axes;
}

}  // namespace placegraph
