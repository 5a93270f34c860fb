#include <placegraph/frontend/segments/segment_flow.h>
#include <placegraph/graph/core/angle.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

/// Half the width of the strip. Chosen.
constexpr int kStrip_px = 7;
/// Maximum number of Gauss-Newton iterations on each level. Chosen.
constexpr int kFlowIterations = 8;
/// Width of the Huber kernel on residuals [grey levels of 255]. Chosen.
constexpr double kRobustGrey = 12;

/// The grid of samples of one level.
struct Grid {
  int columns = 0, half_width = 0;
  double step_px = 1;  ///< across, in pixels of the full image
};

/// Corresponding samples of both strips: grey values and gradients across.
struct Sample {
  double grey_from = 0, gradient_from = 0;
  double u = 0;  ///< along, -1 .. 1
  int row = 0, column = 0;
};

LineSegment moved(const LineSegment& s, double shift, double lean) {
  const Eigen::Vector2d n = s.normal();
  return {s.start + (shift - lean) * n, s.end + (shift + lean) * n};
}

std::vector<Sample> sample_strip(const LineProfileImage& image, const LineSegment& segment,
                                 const Grid& grid, int level) {
  const Eigen::Vector2d across = grid.step_px * segment.normal();
  std::vector<Sample> samples;
  samples.reserve(static_cast<std::size_t>(grid.columns) * (2 * grid.half_width + 1));
  for (int i = 0; i < grid.columns; ++i) {
    const double share = (i + 0.5) / grid.columns;
    const Eigen::Vector2d middle = segment.start + share * segment.vector();
    double before = image.grey(middle - (grid.half_width + 1) * across, level);
    double at = image.grey(middle - grid.half_width * across, level);
    for (int k = -grid.half_width; k <= grid.half_width; ++k) {
      const double after = image.grey(middle + (k + 1) * across, level);
      if (image.contains(middle + k * across))
        samples.push_back({at, 0.5 * (after - before) / grid.step_px, 2 * share - 1, k, i});
      before = at, at = after;
    }
  }
  return samples;
}

/// Aligns one level; false if there is too little gradient.
bool align_level(const LineProfileImage& from, const LineSegment& segment,
                 const LineProfileImage& to, const LineSegment& expected, int level, double& shift,
                 double& lean) {
  Grid grid;
  grid.step_px = 1 << level;
  grid.half_width = kStrip_px;
  grid.columns = std::clamp(static_cast<int>(segment.length() / (2 * grid.step_px)), 4, 24);
  const std::vector<Sample> samples = sample_strip(from, segment, grid, level);
  double gain = 1, bias = 0;
  for (int iteration = 0; iteration < kFlowIterations; ++iteration) {
    const LineSegment now = moved(expected, shift, lean);
    if (now.length() < 1) return false;
    const Eigen::Vector2d across = grid.step_px * now.normal();
    Eigen::Matrix4d H = Eigen::Matrix4d::Zero();
    Eigen::Vector4d g = Eigen::Vector4d::Zero();
    int used = 0;
    for (const Sample& s : samples) {
      const Eigen::Vector2d p =
          now.start + 0.5 * (s.u + 1) * now.vector() + static_cast<double>(s.row) * across;
      if (!to.contains(p)) continue;
      const double grey = to.grey(p, level);
      const double gradient =
          0.5 * (to.grey(p + across, level) - to.grey(p - across, level)) / grid.step_px;
      const double slope = 0.5 * (gradient + gain * s.gradient_from);
      const double residual = grey - gain * s.grey_from - bias;
      const double size = std::abs(residual);
      const double weight = size > kRobustGrey ? kRobustGrey / size : 1;
      const Eigen::Vector4d J(slope, slope * s.u, -s.grey_from, -1);
      H.noalias() += weight * J * J.transpose();
      g.noalias() += weight * residual * J;
      ++used;
    }
    if (2 * used < static_cast<int>(samples.size()) || used < 20) return false;
    H(2, 2) += 100.0 * used;  // [grey levels^2]: prior of the gain, for strips without contrast
    const Eigen::LDLT<Eigen::Matrix4d> ldlt(H + 1e-9 * H.trace() * Eigen::Matrix4d::Identity());
    Eigen::Vector4d step = -ldlt.solve(g);
    if (!step.allFinite()) return false;
    const double limit = 1.5 * grid.step_px;
    const double largest = std::max(std::abs(step[0]), std::abs(step[1]));
    if (largest > limit) step *= limit / largest;
    shift += step[0], lean += step[1], gain += step[2], bias += step[3];
    if (std::max(std::abs(step[0]), std::abs(step[1])) < 0.02 * grid.step_px) break;
  }
  return true;
}

}  // namespace

std::optional<SegmentFlow> follow_segment(const LineProfileImage& from, const LineSegment& segment,
                                          const LineProfileImage& to, const LineSegment& expected,
                                          int coarsest) {
  if (segment.length() < 4 || expected.length() < 4) return std::nullopt;
  double shift = 0, lean = 0;
  for (int level = std::min(coarsest, to.level_of(1 << coarsest)); level >= 0; --level)
    if (!align_level(from, segment, to, expected, level, shift, lean)) return std::nullopt;
  const double angle = std::abs(std::atan2(2 * lean, expected.length()));
  if (angle > deg_to_rad(kMaxSegmentRotation_deg)) return std::nullopt;
  SegmentFlow flow;
  flow.segment = moved(expected, shift, lean);
  flow.shift_px = shift;
  flow.similar =
      compare_strips(from, {segment.start, segment.end, segment.normal()}, to,
                     {flow.segment.start, flow.segment.end, flow.segment.normal()}, kStrip_px);
  return flow;
}

}  // namespace placegraph
