#include <placegraph/frontend/planes/dominant_surface.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/chi_squared.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>

namespace placegraph {
namespace {

/// Number of pixels in one region whose depth is measured. Chosen.
constexpr int kRegionPixels = 400;
/// Minimum share of a region's pixels on the surface. Chosen.
constexpr double kMinSurfaceShare = 0.4;
/// Initial relative standard deviation of the height. Chosen.
constexpr double kMountingSigmaDistance = 0.3;
/// Random walk of pitch and roll from image to image. Chosen.
constexpr double kPitchingSigma_deg = 0.3;
/// Relative random walk of the height from image to image. Chosen.
constexpr double kDistanceDrift = 0.005;
/// Random walk of pitch and roll after a plane that contradicts the filter. Chosen.
constexpr double kSlopeSigma_deg = 2;

using Eigen::Matrix3d;
using Eigen::Vector2f;
using Eigen::Vector3d;

constexpr std::array kRegions{SurfaceRegion::kAhead, SurfaceRegion::kNear, SurfaceRegion::kFar,
                              SurfaceRegion::kLeft, SurfaceRegion::kRight};

/// Bounds in distances of the surface: along the optical axis and to the right.
struct Bounds {
  double near, far, left, right;
};

Bounds bounds_of(SurfaceRegion region, const DominantSurfaceOptions& o) {
  const double w = o.half_width_heights, middle = std::sqrt(o.near_heights * o.far_heights);
  switch (region) {
    case SurfaceRegion::kAhead:
      return {o.near_heights, o.far_heights, -w, w};
    case SurfaceRegion::kNear:
      return {o.near_heights, middle, -w, w};
    case SurfaceRegion::kFar:
      return {middle, 1.5 * o.far_heights, -w, w};
    case SurfaceRegion::kLeft:
      return {o.near_heights, o.far_heights, -3 * w, -0.5 * w};
    case SurfaceRegion::kRight:
      return {o.near_heights, o.far_heights, 0.5 * w, 3 * w};
  }
  return {};
}

}  // namespace

const char* to_string(SurfaceRegion region) {
  constexpr std::array kNames{"ahead", "near", "far", "left", "right"};
  return kNames[static_cast<std::size_t>(region)];
}

DominantSurface::DominantSurface(const DominantSurfaceOptions& options, const Camera& camera,
                                 const Plane& mounting_cam)
    : options_(options),
      camera_(camera),
      g_cam_(mounting_cam.normal.normalized() / mounting_cam.distance_m) {
  options_.check();
  require(mounting_cam.distance_m > 0, "DominantSurface: the distance must be positive");
  widen(deg_to_rad(kMountingSigma_deg), kMountingSigmaDistance);
}

Plane DominantSurface::plane_cam() const { return {g_cam_.normalized(), 1 / g_cam_.norm()}; }

/// Pitch and roll are orthogonal to the normal, the height is along it.
void DominantSurface::widen(double sigma_rad, double sigma_log_distance) {
  const Vector3d n = g_cam_.normalized();
  const Matrix3d along = n * n.transpose();
  covariance_ += g_cam_.squaredNorm() * (sigma_rad * sigma_rad * (Matrix3d::Identity() - along) +
                                         sigma_log_distance * sigma_log_distance * along);
}

/// n' = R n and d' = d + n'^T t, so that g' = R g / (1 + (R g)^T t).
void DominantSurface::predict(const SE3& T_cur_last) {
  const Matrix3d R = T_cur_last.rotation().matrix();
  const Vector3d rotated = R * g_cam_, &t = T_cur_last.translation();
  const double stretch = 1 + rotated.dot(t);
  if (stretch > 0.1) {  // else the motion leads through the surface and is ignored
    const Matrix3d J = (Matrix3d::Identity() - rotated * t.transpose() / stretch) * R / stretch;
    g_cam_ = rotated / stretch;
    covariance_ = J * covariance_ * J.transpose();
  }
  widen(deg_to_rad(kPitchingSigma_deg), kDistanceDrift);
}

std::vector<Vector2f> DominantSurface::pixels_of(SurfaceRegion region, const Image& mask) const {
  const Bounds b = bounds_of(region, options_);
  const double distance = 1 / g_cam_.norm();
  const auto on_grid = [&](int step) {
    std::vector<Vector2f> px;
    for (int v = step / 2; v < camera_.height; v += step)
      for (int u = step / 2; u < camera_.width; u += step) {
        if (!mask.empty() && !mask.at<std::uint8_t>(v, u)) continue;
        const auto ray = camera_.unproject({static_cast<double>(u), static_cast<double>(v)});
        if (!ray) continue;
        const double heights = 1 / (distance * g_cam_.dot(*ray));
        const double right = ray->x() * heights;
        if (heights > b.near && heights < b.far && right > b.left && right < b.right)
          px.emplace_back(static_cast<float>(u), static_cast<float>(v));
      }
    return px;
  };
  // The grid's step follows from the number of pixels of a coarse grid.
  constexpr int kCoarse = 8;
  const double area = kCoarse * kCoarse * static_cast<double>(on_grid(kCoarse).size());
  return on_grid(std::max(1, static_cast<int>(std::sqrt(area / kRegionPixels))));
}

InverseDepthPlane DominantSurface::measure(SurfaceRegion region, const SurfaceDepths& depths,
                                           const Image& mask, Random& random,
                                           SurfaceAppearance& appearance) const {
  const std::vector<Vector2f> px = pixels_of(region, mask);
  std::vector<double> expected;
  for (const Vector2f& p : px)
    expected.push_back(g_cam_.dot(camera_.unproject(p.cast<double>()).value_or(Vector3d::UnitZ())));
  const auto found = depths(px, expected);
  require(found.size() == px.size(), "DominantSurface: needs as many depths as pixels");
  std::vector<MeasuredInverseDepth> known;
  std::vector<Vector2f> known_px;
  for (std::size_t i = 0; i < px.size(); ++i)
    if (found[i]) {
      known.push_back(*found[i]);
      known_px.push_back(px[i]);
    }
  InverseDepthPlane plane = fit_inverse_depth_plane(known, options_.fit, random);
  appearance.region = region;
  appearance.share =
      known.empty() ? 0
                    : static_cast<double>(plane.inliers.size()) / static_cast<double>(known.size());
  appearance.on_px.clear();
  appearance.off_px.clear();
  std::size_t next = 0;
  for (std::size_t i = 0; i < known_px.size(); ++i) {
    const bool on = next < plane.inliers.size() && plane.inliers[next] == static_cast<int>(i);
    next += on;
    (on ? appearance.on_px : appearance.off_px).push_back(known_px[i]);
  }
  return plane;
}

SurfaceAppearance DominantSurface::update(const SurfaceDepths& depths, const SE3& T_cur_last,
                                          const Image& mask, Random& random) {
  require(mask.empty() ||
              (mask.type() == CV_8UC1 && mask.cols == camera_.width && mask.rows == camera_.height),
          "DominantSurface: needs a mask of the camera's size");
  predict(T_cur_last);
  std::vector<SurfaceRegion> order{last_region_};
  for (const SurfaceRegion region : kRegions)
    if (region != last_region_) order.push_back(region);

  SurfaceAppearance best;
  best.outcome = Outcome::failure(Outcome::Code::kTooFewData, "no depths below the horizon");
  for (const SurfaceRegion region : order) {
    SurfaceAppearance appearance;
    const InverseDepthPlane measured = measure(region, depths, mask, random, appearance);
    if (measured.outcome && appearance.share >= kMinSurfaceShare) {
      const Vector3d innovation = measured.g_cam - g_cam_;
      static const double greatest = chi_squared_quantile(0.999, 3);
      const Matrix3d S = covariance_ + measured.covariance;
      appearance.chi2 = innovation.dot(S.ldlt().solve(innovation));
      if (appearance.chi2 < greatest) {
        const Matrix3d gain = S.ldlt().solve(covariance_).transpose();
        g_cam_ += gain * innovation;
        const Matrix3d rest = Matrix3d::Identity() - gain;
        covariance_ =
            rest * covariance_ * rest.transpose() + gain * measured.covariance * gain.transpose();
        appearance.outcome = Outcome::ok();
        last_region_ = region;
        best = std::move(appearance);
        break;
      }
      appearance.outcome = Outcome::failure(Outcome::Code::kInconsistent,
                                            std::string("another plane ") + to_string(region));
    } else {
      appearance.outcome =
          measured.outcome
              ? Outcome::failure(Outcome::Code::kNoConsensus,
                                 "too small a share on a plane " + std::string(to_string(region)))
              : measured.outcome;
    }
    // The reported failure is the one of the latest stage.
    const auto rank = [](const Outcome& o) {
      return o.code == Outcome::Code::kInconsistent ? 2
             : o.code == Outcome::Code::kTooFewData ? 0
                                                    : 1;
    };
    if (rank(appearance.outcome) > rank(best.outcome)) best = std::move(appearance);
  }
  if (best.outcome.code == Outcome::Code::kInconsistent)
    widen(deg_to_rad(kSlopeSigma_deg), kDistanceDrift);
  best.plane_cam = plane_cam();
  best.sigma_normal_rad = placegraph::sigma_normal_rad(g_cam_, covariance_);
  best.sigma_log_distance = placegraph::sigma_log_distance(g_cam_, covariance_);
  return best;
}

}  // namespace placegraph
