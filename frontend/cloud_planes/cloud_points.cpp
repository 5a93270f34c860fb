#include <placegraph/frontend/cloud_planes/cloud_points.h>
#include <placegraph/frontend/cloud_planes/neighbour_tree.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/median.h>
#include <placegraph/graph/core/quantile.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace placegraph {
namespace {

/// Number of neighbours of a point, for a cloud that is not an image.
constexpr int kNeighbours = 8;
constexpr int kNoisePatches = 1500;  ///< number of patches for the noise estimate

void take_points(const PointCloud& cloud, CloudPoints& points) {
  if (cloud.organised()) {
    points.width = cloud.width, points.height = cloud.height;
    points.pixel.assign(cloud.points.size(), -1);
  }
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const Eigen::Vector3d& p = cloud.points[i];
    if (!p.allFinite()) continue;
    if (cloud.organised()) points.pixel[i] = points.size();
    points.xyz.push_back(p);
    points.source.push_back(static_cast<int>(i));
  }
}

/// Neighbours to the right, left, below and above; also across one missing pixel.
void join_pixels(CloudPoints& points) {
  const auto at = [&](int x, int y) {
    return x < 0 || y < 0 || x >= points.width || y >= points.height
               ? -1
               : points.pixel[static_cast<std::size_t>(y) * points.width + x];
  };
  points.begin.reserve(points.xyz.size() + 1);
  points.neighbours.reserve(points.xyz.size() * 4);
  for (const int source : points.source) {
    points.begin.push_back(static_cast<int>(points.neighbours.size()));
    const int x = source % points.width, y = source / points.width;
    for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
      int other = at(x + dx, y + dy);
      if (other < 0) other = at(x + 2 * dx, y + 2 * dy);
      if (other >= 0) points.neighbours.push_back(other);
    }
  }
  points.begin.push_back(static_cast<int>(points.neighbours.size()));
}

void join_nearest(const std::vector<Eigen::Vector3d>& where, const NeighbourTree& tree,
                  CloudPoints& points) {
  std::vector<std::vector<int>> lists(where.size());
  std::vector<int> found;
  for (int i = 0; i < points.size(); ++i) {
    tree.nearest(i, kNeighbours, found);
    for (const int j : found) {
      lists[static_cast<std::size_t>(i)].push_back(j);
      lists[static_cast<std::size_t>(j)].push_back(i);
    }
  }
  for (auto& list : lists) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    points.begin.push_back(static_cast<int>(points.neighbours.size()));
    points.neighbours.insert(points.neighbours.end(), list.begin(), list.end());
  }
  points.begin.push_back(static_cast<int>(points.neighbours.size()));
}

/// Whether points in adjacent directions from the origin have about equal distances: then there is
/// one surface along each ray.
bool seen_from_origin(const std::vector<Eigen::Vector3d>& xyz, const NeighbourTree& by_direction) {
  // Points that are asked and neighbours of each; difference of depths along a ray, and share of
  // the points. Chosen.
  constexpr int kSamples = 1000, kOfEach = 2;
  constexpr double kSimilar = 0.06, kShare = 0.75;
  const int stride = std::max<int>(1, static_cast<int>(xyz.size()) / kSamples);
  std::vector<double> differences;
  std::vector<int> found;
  for (int i = 0; i < static_cast<int>(xyz.size()); i += stride) {
    by_direction.nearest(i, kOfEach, found);
    const double range = xyz[static_cast<std::size_t>(i)].norm();
    for (const int j : found)
      differences.push_back(std::abs(xyz[static_cast<std::size_t>(j)].norm() / range - 1));
  }
  return !differences.empty() && quantile_of(differences, kShare) < kSimilar;
}

/// Points around one, itself first: in an image a square, otherwise neighbours of neighbours. False
/// if the patch is not complete.
bool patch_about(const CloudPoints& points, int i, std::vector<int>& patch) {
  // A patch is 5 x 5 pixels; half of them must be there.
  constexpr int kHalf = 2, kMost = 25, kLeast = 12;
  patch.clear();
  if (points.width > 0) {
    const int source = points.source[static_cast<std::size_t>(i)];
    const int x = source % points.width, y = source / points.width;
    if (x < kHalf || y < kHalf || x >= points.width - kHalf || y >= points.height - kHalf)
      return false;
    for (int v = y - kHalf; v <= y + kHalf; ++v)
      for (int u = x - kHalf; u <= x + kHalf; ++u) {
        const int j = points.pixel[static_cast<std::size_t>(v) * points.width + u];
        if (j < 0) return false;
        patch.push_back(j);
      }
    return true;
  }
  patch.push_back(i);
  for (std::size_t k = 0; k < patch.size() && patch.size() < kMost; ++k)
    for (int n = points.begin[patch[k]]; n < points.begin[patch[k] + 1]; ++n)
      if (std::find(patch.begin(), patch.end(), points.neighbours[n]) == patch.end())
        patch.push_back(points.neighbours[n]);
  return static_cast<int>(patch.size()) >= kLeast;
}

/// Least nonzero second difference of depths along the rows of a square patch: quantized depths
/// have none below a step.
double least_bend(const CloudPoints& points, const std::vector<int>& patch) {
  constexpr std::size_t kSide = 5;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t row = 0; row < kSide; ++row)
    for (std::size_t k = row * kSide; k + 2 < (row + 1) * kSide; ++k) {
      const double bend = std::abs(points.depth[patch[k]] - 2 * points.depth[patch[k + 1]] +
                                   points.depth[patch[k + 2]]);
      if (bend > 1e-6 * points.depth[patch[k]]) least = std::min(least, bend);
    }
  return std::isfinite(least) ? least : 0;
}

CloudNoise measure_noise(const CloudPoints& points, double step_m) {
  constexpr double kQuiet = 0.35,
                   kSteps = 12;  // variance of a uniform distribution over one step: 1/12
  struct Reading {
    double depth, sigma;
  };
  std::vector<Reading> readings;
  std::vector<int> patch;
  const int stride = std::max(1, points.size() / kNoisePatches);
  for (int i = 0; i < points.size(); i += stride) {
    if (!patch_about(points, i, patch)) continue;
    PlaneSums sums;
    for (const int j : patch) {
      FitPoint point = points.fit[static_cast<std::size_t>(j)];
      point.weight = 1;
      sums.add(point, points.model);
    }
    const FittedPlane fit = sums.fit(points.model);
    if (!fit.ok) continue;
    double sigma = std::sqrt(fit.chi2 / (sums.count() - 3));
    const double depth = points.depth[static_cast<std::size_t>(i)];
    if (points.model.noise == PointNoise::kAlongRay) sigma *= depth * depth;
    if (points.width > 0) sigma = std::max(sigma, least_bend(points, patch) / std::sqrt(kSteps));
    readings.push_back({depth, sigma});
  }
  CloudNoise noise;
  noise.least_m = step_m / std::sqrt(kSteps);
  if (readings.empty()) return noise;
  double best = std::numeric_limits<double>::infinity();
  const bool along = points.model.noise == PointNoise::kAlongRay;
  for (const int power : {1, 2, 0}) {
    if (power > 0 && !along) continue;
    std::vector<double> units;
    for (const Reading& r : readings) units.push_back(r.sigma / std::pow(r.depth, power));
    const double low = quantile_of(units, 0.15), high = quantile_of(units, 0.55);
    const double spread = low > 0 ? high / low : std::numeric_limits<double>::max();
    if (!(spread < 0.9 * best)) continue;
    best = spread;
    noise.power = power;
    noise.at_1m = quantile_of(units, kQuiet);
  }
  return noise;
}

/// Part of the noise that remains in the means of 4x4 blocks, relative to the planes of 16x16
/// pixels, beyond chance: its variance over that of the noise, in the least noisy third of them.
double measure_shared(const CloudPoints& points) {
  constexpr int kSide = 16, kBlock = 4, kBlocks = kSide / kBlock;
  constexpr double kQuiet = 0.35, kMeans = kBlocks * kBlocks, kInBlock = kBlock * kBlock, kDof = 3;
  constexpr int kPatches = 400;
  const int across = points.width / kSide, down = points.height / kSide;
  const int stride = std::max(1, across * down / kPatches);
  std::vector<double> shares;
  for (int patch = 0; patch < across * down; patch += stride) {
    const int x0 = patch % across * kSide, y0 = patch / across * kSide;
    PlaneSums sums;
    for (int y = y0; y < y0 + kSide; ++y)
      for (int x = x0; x < x0 + kSide; ++x)
        if (const int i = points.pixel[static_cast<std::size_t>(y) * points.width + x]; i >= 0)
          sums.add(points.fit[i], points.model);
    const FittedPlane fit = sums.fit(points.model);
    if (sums.count() < kSide * kSide || !fit.ok) continue;
    std::array<double, kBlocks * kBlocks> means{};
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        const int i = points.pixel[static_cast<std::size_t>(y0 + y) * points.width + x0 + x];
        const FitPoint& point = points.fit[i];
        means[y / kBlock * kBlocks + x / kBlock] +=
            (point.value - fit.g.dot(point.q)) * std::sqrt(point.weight) / kInBlock;
      }
    double square = 0;
    for (const double mean : means) square += mean * mean;
    shares.push_back(square / (kMeans - kDof) - 1 / kInBlock);
  }
  // If few patches are flat, the rest is due to the surface: no sensor shares more than its noise.
  constexpr double kMost = 1;
  return shares.empty() ? 0 : std::clamp(quantile_of(shares, kQuiet), 0.0, kMost);
}

}  // namespace

CloudPoints prepare_cloud(const PointCloud& cloud, double flatness) {
  CloudPoints points;
  require(!cloud.organised() || cloud.points.size() == static_cast<std::size_t>(cloud.width) *
                                                           static_cast<std::size_t>(cloud.height),
          "cloud: needs a point for every pixel");
  take_points(cloud, points);
  points.model = {PointNoise::kAlongRay, flatness};
  points.fit.resize(points.xyz.size());
  points.depth.resize(points.xyz.size());
  const auto ray_of = [&](std::size_t i, double depth) {
    points.depth[i] = depth;
    points.fit[i].q = points.xyz[i] / depth;
    points.fit[i].value = 1 / depth;
  };
  if (cloud.organised()) {
    for (std::size_t i = 0; i < points.xyz.size(); ++i) {
      require(points.xyz[i].z() > 0, "cloud: a pixel with a depth that is not positive");
      ray_of(i, points.xyz[i].z());
    }
    join_pixels(points);
  } else if (points.size() > 0) {
    std::vector<Eigen::Vector3d> rays;
    bool from_origin = true;
    for (const Eigen::Vector3d& p : points.xyz) {
      from_origin = from_origin && p.norm() > 1e-9;
      rays.push_back(p.normalized());
    }
    const NeighbourTree by_direction(rays);
    if (from_origin && seen_from_origin(points.xyz, by_direction)) {
      for (std::size_t i = 0; i < points.xyz.size(); ++i) ray_of(i, points.xyz[i].norm());
      join_nearest(rays, by_direction, points);
    } else {
      Eigen::Vector3d mean = Eigen::Vector3d::Zero();
      for (const Eigen::Vector3d& p : points.xyz) mean += p / points.size();
      std::vector<double> radii;
      for (std::size_t i = 0; i < points.xyz.size(); ++i) {
        radii.push_back((points.xyz[i] - mean).norm());
        points.fit[i].q = points.xyz[i];
      }
      points.model = {PointNoise::kIsotropic, flatness * median_of(radii)};
      join_nearest(points.xyz, NeighbourTree(points.xyz), points);
    }
  }
  points.noise = measure_noise(points, cloud.step_m);
  for (std::size_t i = 0; i < points.xyz.size(); ++i) {
    const double depth = points.depth[i];
    double sigma = points.noise.sigma(depth);
    if (points.model.noise == PointNoise::kAlongRay)
      sigma /= depth * depth;
    else
      sigma = std::max(sigma, points.model.flatness * 1e-2 + 1e-12);
    points.fit[i].weight = 1 / (sigma * sigma);
  }
  if (points.width > 0) points.noise.shared = points.model.shared = measure_shared(points);
  return points;
}

}  // namespace placegraph
