#include <placegraph/frontend/scene/popup.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace placegraph {
namespace {

constexpr int kSky = static_cast<int>(Surface::kSky), kGround = static_cast<int>(Surface::kGround);

/// Contiguous pixels of one surface in a column, rows [top, bottom].
struct Run {
  int top, bottom, surface;
  double foot_m = 0;  ///< distance of the ground at its foot; 0 without a visible foot
};

Eigen::Vector3d ray_of(const Camera& camera, double u, double v) {
  return {(u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, 1};
}

double over_ground(const Eigen::Vector3d& p, const Eigen::Vector3d& down) {
  return (p - p.dot(down) * down).norm();
}

std::vector<Run> runs_of(const Image& surfaces, const GroundView& view, int u, double farthest_m) {
  std::vector<Run> runs;
  for (int v = surfaces.rows - 1; v >= 0; --v) {
    const int surface = surfaces.at<std::uint8_t>(v, u);
    if (surface == kSky || surface == kGround || surface >= kSurfaceCount) continue;
    if (!runs.empty() && runs.back().surface == surface && runs.back().top == v + 1) {
      runs.back().top = v;
      continue;
    }
    Run run{v, v, surface};
    const bool on_ground = v + 1 < surfaces.rows && surfaces.at<std::uint8_t>(v + 1, u) == kGround;
    if (on_ground || v + 1 == surfaces.rows) {
      const auto foot = ground_point(view, {static_cast<double>(u), v + 0.5});
      run.foot_m = foot ? std::min(over_ground(*foot, view.down), farthest_m) : farthest_m;
    }
    runs.push_back(run);
  }
  return runs;
}

/// Inverse distances of the feet of one surface in every column: visible ones (the farthest of a
/// column), linear interpolation between them, the nearest one's outside; empty if none is visible.
std::vector<double> feet_of(const std::vector<std::vector<Run>>& columns, int surface) {
  std::vector<double> inverse(columns.size(), 0);
  std::vector<std::size_t> seen;
  for (std::size_t u = 0; u < columns.size(); ++u) {
    for (const Run& run : columns[u])
      if (run.surface == surface && run.foot_m > 0) inverse[u] = 1 / run.foot_m;
    if (inverse[u] > 0) seen.push_back(u);
  }
  if (seen.empty()) return {};
  for (std::size_t u = 0; u < columns.size(); ++u) {
    if (inverse[u] > 0) continue;
    const auto next = std::lower_bound(seen.begin(), seen.end(), u);
    const std::size_t right = next == seen.end() ? seen.back() : *next;
    const std::size_t left = next == seen.begin() ? seen.front() : *(next - 1);
    const double part =
        right > left ? static_cast<double>(u - left) / static_cast<double>(right - left) : 0;
    inverse[u] = (1 - part) * inverse[left] + part * inverse[right];
  }
  return inverse;
}

void stand_up(const std::vector<Run>& runs, std::size_t u,
              const std::array<std::vector<double>, kSurfaceCount>& feet, double farthest_m,
              Image& distance) {
  double before = 0;  // runs below in the column are nearer
  for (const Run& run : runs) {
    double m = run.foot_m;
    if (m <= 0) {
      const std::vector<double>& inverse = feet[static_cast<std::size_t>(run.surface)];
      m = std::max(before, inverse.empty() ? farthest_m : 1 / inverse[u]);
    }
    for (int v = run.top; v <= run.bottom; ++v)
      distance.at<float>(v, static_cast<int>(u)) = static_cast<float>(m);
    before = m;
  }
}

/// Directions forward and to the right over the ground.
std::array<Eigen::Vector3d, 2> directions_of(const GroundView& view) {
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d forward = (z - z.dot(view.down) * view.down).normalized();
  return {forward, view.down.cross(forward)};
}

}  // namespace

std::optional<Eigen::Vector3d> ground_point(const GroundView& view, const Eigen::Vector2d& px) {
  const Eigen::Vector3d ray = ray_of(view.camera, px.x(), px.y());
  const double fall = view.down.dot(ray);
  if (fall <= 1e-9) return std::nullopt;
  return view.height_m / fall * ray;
}

Eigen::Vector3d ground_place(const GroundView& view, double right_m, double forward_m) {
  const auto [forward, right] = directions_of(view);
  return view.height_m * view.down + right_m * right + forward_m * forward;
}

PopUp pop_up(const Image& surfaces, const GroundView& view, double farthest_m) {
  view.camera.check();
  require(surfaces.type() == CV_8UC1 && surfaces.cols == view.camera.width &&
              surfaces.rows == view.camera.height,
          "pop_up: the surfaces do not have the camera's size");
  require(view.height_m > 0 && farthest_m > 0,
          "pop_up: height and farthest distance must be positive");
  PopUp popup{Image::zeros(surfaces.size(), CV_32FC1)};
  std::vector<std::vector<Run>> columns;
  for (int u = 0; u < surfaces.cols; ++u) columns.push_back(runs_of(surfaces, view, u, farthest_m));
  std::array<std::vector<double>, kSurfaceCount> feet;
  for (int s = 0; s < kSurfaceCount; ++s) feet[static_cast<std::size_t>(s)] = feet_of(columns, s);
  for (int u = 0; u < surfaces.cols; ++u) {
    stand_up(columns[static_cast<std::size_t>(u)], static_cast<std::size_t>(u), feet, farthest_m,
             popup.distance);
    for (int v = 0; v < surfaces.rows; ++v) {
      const int surface = surfaces.at<std::uint8_t>(v, u);
      float& m = popup.distance.at<float>(v, u);
      if (surface == kSky) m = std::numeric_limits<float>::infinity();
      if (surface != kGround) continue;
      const auto point = ground_point(view, {static_cast<double>(u), static_cast<double>(v)});
      m = static_cast<float>(point ? std::min(over_ground(*point, view.down), farthest_m)
                                   : farthest_m);
    }
  }
  return popup;
}

std::optional<Eigen::Vector3d> popped_point(const PopUp& popup, const GroundView& view, int u,
                                            int v) {
  const auto m = static_cast<double>(popup.distance.at<float>(v, u));
  if (!(m > 0) || std::isinf(m)) return std::nullopt;
  const Eigen::Vector3d ray = ray_of(view.camera, u, v);
  return m / over_ground(ray, view.down) * ray;
}

Image overlay_box(const Image& bgr, const PopUp& popup, const GroundView& view,
                  const StandingBox& box, Image* hidden) {
  require(bgr.type() == CV_8UC3 && bgr.size() == popup.distance.size(),
          "overlay_box: needs a BGR image of the camera's size");
  std::array<std::vector<cv::Point>, 2> faces;  // the far one first
  std::vector<cv::Point> whole;
  for (const int back : {1, 0})
    for (const auto& [side, up] : {std::pair{-1, 0}, {1, 0}, {1, 1}, {-1, 1}}) {
      const Eigen::Vector3d foot = ground_place(view, box.right_m + side * box.width_m / 2,
                                                box.forward_m + (back ? 0.5 : -0.5) * box.depth_m);
      const Eigen::Vector3d corner = foot - up * box.tall_m * view.down;
      require(corner.z() > 0.1, "overlay_box: the box reaches behind the camera");
      const cv::Point px(
          static_cast<int>(std::lround(view.camera.fx * corner.x() / corner.z() + view.camera.cx)),
          static_cast<int>(std::lround(view.camera.fy * corner.y() / corner.z() + view.camera.cy)));
      faces[back ? 0 : 1].push_back(px);
      whole.push_back(px);
    }
  std::vector<cv::Point> outline;
  cv::convexHull(whole, outline);
  Image mask = Image::zeros(bgr.size(), CV_8UC1), drawn = bgr.clone();
  cv::fillConvexPoly(mask, outline, cv::Scalar(255));
  cv::fillConvexPoly(drawn, outline, cv::Scalar(40, 120, 200));
  cv::fillConvexPoly(drawn, faces[1], cv::Scalar(60, 170, 250));
  // The box is at the distance of its middle over the ground: nearer surfaces hide it, but the
  // ground in front of it does not.
  const double m = over_ground(ground_place(view, box.right_m, box.forward_m), view.down);
  for (int v = 0; v < bgr.rows; ++v)
    for (int u = 0; u < bgr.cols; ++u) {
      if (mask.at<std::uint8_t>(v, u) == 0) continue;
      const auto there = static_cast<double>(popup.distance.at<float>(v, u));
      const auto ground = ground_point(view, {static_cast<double>(u), static_cast<double>(v)});
      const bool is_ground =
          ground && std::abs(over_ground(*ground, view.down) - there) < 1e-3 * there;
      if (there <= 0 || is_ground || there >= m) continue;
      mask.at<std::uint8_t>(v, u) = 128;
      drawn.at<cv::Vec3b>(v, u) = bgr.at<cv::Vec3b>(v, u);
    }
  if (hidden) *hidden = mask;
  return drawn;
}

}  // namespace placegraph
