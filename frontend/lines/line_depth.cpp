#include <placegraph/frontend/features/depth_lookup.h>
#include <placegraph/frontend/lines/line_depth.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

namespace placegraph {
namespace {

// Columns of samples along a segment. Chosen.
constexpr int kColumns = 12;
constexpr std::array<double, 3> kRows_px{3, 5, 8};  // distances from the edge
constexpr double kLeastShare = 0.5;                 // least share of columns with depth

/// Inverse depth at both ends by a plane through samples beside the segment.
struct Side {
  Eigen::Vector2d ends = Eigen::Vector2d::Zero();
  double dispersion = 0;
};

/// Fits a plane to samples: position along the segment (0 to 1), distance across, inverse depth.
std::optional<Side> fit_plane(const std::vector<Eigen::Vector3d>& samples, double sigma) {
  // Fits, each without what is beyond three deviations of the last. Chosen.
  constexpr int kRounds = 3;
  constexpr double kGate = 3;
  std::vector<Eigen::Vector3d> kept = samples;
  Eigen::Vector3d plane = Eigen::Vector3d::Zero();
  double dispersion = 0;
  for (int round = 0; round < kRounds; ++round) {
    if (static_cast<double>(kept.size()) < std::max(6.0, kLeastShare * kColumns * kRows_px.size()))
      return std::nullopt;
    Eigen::Matrix3d N = Eigen::Matrix3d::Zero();
    Eigen::Vector3d b = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& s : kept) {
      const Eigen::Vector3d row(1 - s[0], s[0], s[1] / 10);
      N += row * row.transpose();
      b += s[2] * row;
    }
    plane = N.ldlt().solve(b);
    const auto miss = [&](const Eigen::Vector3d& s) {
      return std::abs(plane.dot(Eigen::Vector3d(1 - s[0], s[0], s[1] / 10)) - s[2]);
    };
    std::vector<double> misses;
    for (const Eigen::Vector3d& s : kept) misses.push_back(miss(s));
    std::nth_element(misses.begin(), misses.begin() + misses.size() / 2, misses.end());
    dispersion = std::max(0.3 * sigma, 1.4826 * misses[misses.size() / 2]);
    if (round + 1 == kRounds) break;
    kept.clear();
    for (const Eigen::Vector3d& s : samples)
      if (miss(s) < kGate * dispersion) kept.push_back(s);
  }
  if (!plane.allFinite() || dispersion > 6 * sigma || plane[0] <= 0 || plane[1] <= 0)
    return std::nullopt;
  return Side{plane.head<2>(), dispersion};
}

}  // namespace

std::vector<std::optional<DepthAlong>> lookup_depth_along(
    const Image& depth_m, const Camera& camera, const DepthCamera& depth_camera,
    const std::vector<LineSegment>& segments) {
  DepthLookupOptions options;
  options.margin_focal_px = camera.fx;  // the margin is in pixels of this camera
  options.margin_px = 1;                // small on purpose: each side is checked as a whole
  std::vector<Eigen::Vector2f> px;
  for (const LineSegment& segment : segments)
    for (const double side : {-1.0, 1.0})
      for (const double row : kRows_px)
        for (int k = 0; k < kColumns; ++k)
          px.push_back((segment.start + (k + 0.5) / kColumns * segment.vector() +
                        side * row * segment.normal())
                           .cast<float>());
  const auto depths = lookup_depth(depth_m, camera, depth_camera, px, options);
  // Depth noise grows with the square of the depth: inverse depth has the noise of 1 m everywhere.
  const double sigma = depth_camera.sigma_at_1m;
  std::vector<std::optional<DepthAlong>> result(segments.size());
  std::size_t next = 0;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    std::optional<Side> sides[2];
    for (auto& side : sides) {
      std::vector<Eigen::Vector3d> samples;
      for (const double row : kRows_px)
        for (int k = 0; k < kColumns; ++k, ++next)
          if (depths[next]) samples.emplace_back((k + 0.5) / kColumns, row, 1 / *depths[next]);
      side = fit_plane(samples, sigma);
    }
    if (!sides[0] && !sides[1]) continue;
    Eigen::Vector2d ends = sides[0] ? sides[0]->ends : sides[1]->ends;
    if (sides[0] && sides[1]) {
      constexpr double kOneSurface = 8;  // standard deviations of a depth
      const Eigen::Vector2d a = sides[0]->ends, b = sides[1]->ends;
      if ((a - b).cwiseAbs().maxCoeff() < kOneSurface * sigma)
        ends = 0.5 * (a + b);
      else if ((a - b).minCoeff() > 0 || (a - b).maxCoeff() < 0)
        ends = a.sum() > b.sum() ? a : b;
      else
        continue;  // the sides cross: neither belongs to the whole edge
    }
    result[i] = DepthAlong{ends[0], ends[1], sigma};
  }
  return result;
}

VirtualCamera virtual_camera_from_depth(const Camera& camera, const LineSegment& segment,
                                        const DepthAlong& depth) {
  constexpr double kBaseline = 0.1;  // [m]; arbitrary: errors scale with it
  const Eigen::Vector2d n = segment.normal();
  VirtualCamera second;
  second.second_in_cam << kBaseline * n, 0;
  const Eigen::Vector2d shift(camera.fx * kBaseline * n.x(), camera.fy * kBaseline * n.y());
  second.seen.first = segment.start - depth.inverse_depth_start * shift;
  second.seen.second = segment.end - depth.inverse_depth_end * shift;
  second.seen.sigma_px = depth.sigma * std::abs(shift.dot(n));
  return second;
}

}  // namespace placegraph
