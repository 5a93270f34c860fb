#include <placegraph/frontend/scene/street_geometry.h>
#include <placegraph/graph/core/median.h>
#include <placegraph/graph/core/random.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace placegraph {
namespace {

/// Minimum standard deviation of the disparity of one pixel. Chosen.
constexpr double kDisparitySigma_px = 0.25;
/// Unevenness of the ground at the camera. Chosen.
constexpr double kGroundSigma_m = 0.03;
/// Increase of that unevenness per metre of distance [m/m]. Chosen.
constexpr double kGroundSigmaRate = 0.004;

// Farther points bend the plane of the ground. Chosen.
constexpr double kFarthestForPlane_m = 25;
// In front of the camera is road; the ground beside it may be higher.
constexpr double kHalfRoad_m = 3.5;
constexpr std::size_t kFewest = 60;

/// Range of heights above the ground [m] in which a class occurs.
struct ClassHeights {
  const char* name;
  double low, high;
};
constexpr ClassHeights kHeights[] = {
    {"Road", 0, 0},       {"Pavement", 0.05, 0.15}, {"Building", 0, 12}, {"Pole", 0, 8},
    {"Tree", 0, 10},      {"Sign", 0.8, 5},         {"Fence", 0, 2.2},   {"Car", 0, 1.9},
    {"Pedestrian", 0, 2}, {"Bicyclist", 0, 2}};

ClassHeights heights_of(const std::string& name, Surface surface) {
  for (const ClassHeights& heights : kHeights)
    if (name == heights.name) return heights;
  switch (surface) {
    case Surface::kGround:
      return {"", 0, 0.1};
    case Surface::kObject:
      return {"", 0, 2.2};
    default:
      return {"", 0, 10};
  }
}

double normal_cdf(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }

/// Density of a value that is uniform between two ends and measured with `sigma`.
double soft_box(double value, double low, double high, double sigma) {
  const double width = high - low;
  if (width < 0.2 * sigma) {
    const double x = (value - 0.5 * (low + high)) / sigma;
    return std::exp(-0.5 * x * x) / (sigma * std::sqrt(2 * std::numbers::pi));
  }
  return (normal_cdf((value - low) / sigma) - normal_cdf((value - high) / sigma)) / width;
}

/// Height of a point above the plane down . p = h.
double above(const Eigen::Vector3d& down, double height, const Eigen::Vector3d& p) {
  return height - down.dot(p);
}

struct PlaneFit {
  Eigen::Vector3d down = Eigen::Vector3d::UnitY();
  double height = 0;
  bool good = false;
};

/// Weighted least squares of down . p = h, with errors in the coordinate y.
PlaneFit fit_plane(const std::vector<Eigen::Vector3d>& points, const std::vector<double>& weights) {
  Eigen::Matrix3d A = 1e-9 * Eigen::Matrix3d::Identity();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d row(points[i][0], points[i][2], 1);
    A += weights[i] * row * row.transpose();
    b += weights[i] * row * points[i][1];
  }
  const Eigen::Vector3d s = A.ldlt().solve(b);  // y = s0 x + s1 z + s2
  const Eigen::Vector3d n(-s[0], 1, -s[1]);
  return {n.normalized(), s[2] / n.norm(), s.allFinite()};
}

/// Plane with the least median distance from the points, among many through three of them.
PlaneFit search_plane(const std::vector<Eigen::Vector3d>& points, const std::vector<double>& sigmas,
                      Random& random) {
  // Samples of three points, and the steepest ground [m/m]. Chosen.
  constexpr int kTries = 60;
  constexpr double kSteepest = 0.2;
  PlaneFit best;
  double least = 1e300;
  std::vector<double> residuals(points.size());
  for (int k = 0; k < kTries; ++k) {
    std::vector<Eigen::Vector3d> three;
    for (int i = 0; i < 3; ++i)
      three.push_back(
          points[static_cast<std::size_t>(random.index(static_cast<int>(points.size())))]);
    const PlaneFit fit = fit_plane(three, {1, 1, 1});
    if (!fit.good || fit.down[1] < std::cos(kSteepest) || fit.height < 0.3) continue;
    for (std::size_t i = 0; i < points.size(); ++i)
      residuals[i] = std::abs(above(fit.down, fit.height, points[i])) / sigmas[i];
    // At least half of the probable ground points are assumed to be ground.
    if (const double median = median_of(residuals); median < least) least = median, best = fit;
  }
  return best;
}

}  // namespace

double GroundProfile::height_of(const Eigen::Vector3d& point) const {
  double rise = 0;
  if (!rise_m.empty()) {
    const double at =
        std::clamp(point[2] / kStep_m - 0.5, 0.0, static_cast<double>(rise_m.size() - 1));
    const auto low = static_cast<std::size_t>(at), high = std::min(low + 1, rise_m.size() - 1);
    rise = rise_m[low] + (at - static_cast<double>(low)) * (rise_m[high] - rise_m[low]);
  }
  return above(down, camera_height_m, point) - rise;
}

GroundProfile fit_ground(const std::vector<DepthSample>& samples,
                         const std::vector<float>& ground_share, double camera_height_m) {
  GroundProfile profile;
  profile.camera_height_m = camera_height_m;
  std::vector<Eigen::Vector3d> points, all;
  std::vector<double> sigmas;
  const auto sigma_of = [&](const Eigen::Vector3d& p) {
    return kGroundSigma_m + kGroundSigmaRate * p[2];
  };
  for (const DepthSample& sample : samples) {
    if (ground_share[static_cast<std::size_t>(sample.superpixel)] < 0.5F) continue;
    const Eigen::Vector3d p = sample.point.cast<double>();
    if (p[1] < 0.3 - 0.08 * p[2]) continue;  // above the slope of any street
    if (std::abs(p[0]) > kHalfRoad_m) continue;
    all.push_back(p);
    if (p[2] > kFarthestForPlane_m) continue;
    points.push_back(p);
    sigmas.push_back(sigma_of(p));
  }
  if (points.size() < kFewest) {
    profile.outcome = Outcome::failure(Outcome::Code::kTooFewData, "no ground in the image");
    return profile;
  }
  Random random(7);
  PlaneFit fit = search_plane(points, sigmas, random);
  if (!fit.good) {
    profile.outcome = Outcome::failure(Outcome::Code::kTooFewData, "no plane under the camera");
    return profile;
  }
  std::vector<double> weights(points.size());
  for (int round = 0; round < 5; ++round) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double x = above(fit.down, fit.height, points[i]) / (2 * sigmas[i]);
      weights[i] = std::abs(x) < 1 ? std::pow((1 - x * x) / sigmas[i], 2) : 0;
    }
    const PlaneFit next = fit_plane(points, weights);
    if (!next.good || next.height < 0.3) break;
    fit = next;
  }
  profile.outcome = Outcome::ok();
  profile.down = fit.down;
  profile.camera_height_m = fit.height;
  // Hills: height of the ground above the plane farther away, extrapolated beyond the samples.
  std::vector<std::vector<double>> rises;
  for (const Eigen::Vector3d& p : all) {
    const auto bin = static_cast<std::size_t>(std::max(0.0, p[2] / GroundProfile::kStep_m));
    const double rise = above(fit.down, fit.height, p);
    if (bin > 50 || std::abs(rise) > 4 * sigma_of(p) + 0.01 * p[2]) continue;
    if (bin >= rises.size()) rises.resize(bin + 1);
    rises[bin].push_back(rise);
  }
  double last = 0;
  for (const auto& bin : rises) {
    // Points with a median. Chosen.
    constexpr std::size_t kEnough = 15;
    if (bin.size() >= kEnough) last = median_of(bin);
    profile.rise_m.push_back(last);
  }
  return profile;
}

namespace {

/// Disparity over the pixels of a region [px]: coefficients . (u - middle_u, v - middle_v, 1).
struct DisparityPlane {
  Eigen::Vector3d coefficients = Eigen::Vector3d::Zero();
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  ///< mean of the pixels, (u, v, 0)
  Eigen::Matrix3d inverse;                           ///< inverse of the normal equations' matrix
  double sigma_px = 0;  ///< dispersion of the disparities about the plane
};

/// Reweighted least squares (Tukey) over the samples of a region.
DisparityPlane fit_disparity(const std::vector<const DepthSample*>& samples,
                             const std::vector<double>& depths, double disparity_m_px) {
  DisparityPlane plane;
  // About the mean, for a good condition number; inverse depth is linear on a plane.
  for (const DepthSample* s : samples)
    plane.middle += Eigen::Vector3d(s->u, s->v, 0) / static_cast<double>(samples.size());
  const Eigen::Vector3d& middle = plane.middle;
  std::vector<double> residuals(samples.size(), 0), weights(samples.size(), 1);
  Eigen::Vector3d& s = plane.coefficients;
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  for (int round = 0; round < 4; ++round) {
    A.setZero();
    Eigen::Vector3d b = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const Eigen::Vector3d row(static_cast<double>(samples[i]->u) - middle[0],
                                static_cast<double>(samples[i]->v) - middle[1], 1);
      A += weights[i] * row * row.transpose();
      b += weights[i] * row * (disparity_m_px / depths[i]);
    }
    s = (A + 1e-6 * Eigen::Matrix3d::Identity()).ldlt().solve(b);
    for (std::size_t i = 0; i < samples.size(); ++i)
      residuals[i] =
          std::abs(disparity_m_px / depths[i] -
                   s.dot(Eigen::Vector3d(static_cast<double>(samples[i]->u) - middle[0],
                                         static_cast<double>(samples[i]->v) - middle[1], 1)));
    plane.sigma_px = std::max(kDisparitySigma_px, 1.48 * median_of(residuals));
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const double x = residuals[i] / (3 * plane.sigma_px);
      weights[i] = x < 1 ? std::pow(1 - x * x, 2) : 0;
    }
  }
  plane.inverse = (A + 1e-6 * Eigen::Matrix3d::Identity()).inverse();
  return plane;
}

/// Robust fit of the samples of one region.
RegionPlace place_region(const std::vector<const DepthSample*>& samples, const Camera& camera,
                         double disparity_m_px, const GroundProfile& ground) {
  // Twice the unknowns of a plane.
  constexpr std::size_t kLeast = 6;
  RegionPlace place;
  place.samples = static_cast<int>(samples.size());
  if (samples.size() < kLeast) return place;
  std::vector<double> depths, heights;
  for (const DepthSample* s : samples) {
    depths.push_back(static_cast<double>(s->point[2]));
    heights.push_back(ground.height_of(s->point.cast<double>()));
  }
  place.depth_m = median_of(depths);
  place.height_m = median_of(heights);
  std::nth_element(heights.begin(),
                   heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 10),
                   heights.end());
  place.low_m = heights[heights.size() / 10];
  const DisparityPlane fit = fit_disparity(samples, depths, disparity_m_px);
  const Eigen::Vector3d &s = fit.coefficients, &middle = fit.middle;
  place.disparity_sigma_px = fit.sigma_px;
  // disparity = a u + b v + c  =>  1/z = (a fx x + b fy y + c') / fB with x, y normalized.
  place.plane =
      Eigen::Vector3d(s[0] * camera.fx, s[1] * camera.fy,
                      s[2] + s[0] * (camera.cx - middle[0]) + s[1] * (camera.cy - middle[1])) /
      disparity_m_px;
  const double length = place.plane.norm();
  if (!(length > 0) || !std::isfinite(length)) return place;
  place.upness = std::abs(place.plane.dot(ground.down)) / length;
  // The errors of neighbouring disparities are correlated: a block of the matcher's window counts
  // as one.
  constexpr double kTogether = 4;
  const double slope =
      std::sqrt(kTogether * std::max(0.0, std::max(fit.inverse(0, 0), fit.inverse(1, 1)))) *
      place.disparity_sigma_px * camera.fx / disparity_m_px;
  place.upness_sigma = std::min(1.0, slope / length + 0.05);
  return place;
}

}  // namespace

std::vector<RegionPlace> place_regions(const std::vector<DepthSample>& samples, int regions,
                                       const Camera& camera, double disparity_m_px,
                                       const GroundProfile& ground) {
  std::vector<std::vector<const DepthSample*>> of(static_cast<std::size_t>(regions));
  for (const DepthSample& sample : samples)
    of[static_cast<std::size_t>(sample.superpixel)].push_back(&sample);
  std::vector<RegionPlace> places;
  for (const auto& region : of)
    places.push_back(place_region(region, camera, disparity_m_px, ground));
  return places;
}

std::vector<float> geometry_log_likelihoods(const std::vector<RegionPlace>& regions,
                                            const SceneModel& model,
                                            const StreetGeometryOptions& options) {
  const std::size_t n = model.classes.size();
  std::vector<float> log_likelihoods(regions.size() * n, 0.0F);
  if (options.weight == 0) return log_likelihoods;
  std::vector<ClassHeights> heights;
  for (std::size_t c = 0; c < n; ++c)
    heights.push_back(heights_of(model.classes[c], model.surfaces[c]));
  // Heights over which an outlier is uniform. Chosen.
  constexpr double kHeightRange_m = 14, kFloorDensity = 1 / kHeightRange_m;
  for (std::size_t i = 0; i < regions.size(); ++i) {
    const RegionPlace& r = regions[i];
    if (r.plane.isZero()) continue;
    const double sigma = std::hypot(kGroundSigma_m, kGroundSigmaRate * r.depth_m);
    for (std::size_t c = 0; c < n; ++c) {
      const Surface surface = model.surfaces[c];
      double likelihood = 0;
      if (surface != Surface::kSky) {
        const double height = soft_box(r.height_m, heights[c].low, heights[c].high, sigma);
        double orientation = 1;
        if (surface == Surface::kGround)
          orientation = soft_box(r.upness, 0.9, 1.1, r.upness_sigma);
        else if (model.classes[c] == "Building" || model.classes[c] == "Fence")
          orientation = soft_box(r.upness, -0.2, 0.2, r.upness_sigma);
        // The orientation does not count if it is not observable.
        const double seen = std::max(0.0, 1 - r.upness_sigma / 0.6);
        likelihood = height * (1 + seen * (orientation - 1));
      }
      const double p = (1 - options.outliers) * likelihood + options.outliers * kFloorDensity;
      log_likelihoods[i * n + c] = static_cast<float>(options.weight * std::log(p));
    }
  }
  return log_likelihoods;
}

}  // namespace placegraph
