#include <placegraph/frontend/align/planar_template.h>
#include <placegraph/frontend/flow/grey_pyramid.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace placegraph {
namespace {

using Eigen::Vector2d;

/// Whether a point is inside a polygon, by the even-odd rule.
bool inside(const std::vector<Vector2d>& polygon, const Vector2d& p) {
  bool in = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Vector2d &a = polygon[i], &b = polygon[j];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    in ^= p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
  }
  return in;
}

/// The pixels of a level that belong to a region.
struct Region {
  const std::vector<Vector2d>& polygon;
  const Image& mask;
  double scale;  // pixels of the image per pixel of the level
  int left, top, right, bottom;

  Region(const std::vector<Vector2d>& polygon_px, const Image& mask_ref, const Image& level,
         double level_scale)
      : polygon(polygon_px), mask(mask_ref), scale(level_scale) {
    Vector2d low = polygon[0], high = polygon[0];
    for (const Vector2d& p : polygon) low = low.cwiseMin(p), high = high.cwiseMax(p);
    low /= scale, high /= scale;
    const auto bound = [](double value, int most) {
      return static_cast<int>(std::clamp(value, 1.0, std::max(1.0, most - 2.0)));
    };
    left = bound(std::ceil(low.x()), level.cols), top = bound(std::ceil(low.y()), level.rows);
    right = bound(std::floor(high.x()), level.cols);
    bottom = bound(std::floor(high.y()), level.rows);
  }
  bool contains(int u, int v) const {
    const Vector2d px(u * scale, v * scale);
    if (!inside(polygon, px)) return false;
    if (mask.empty()) return true;
    const int mu = static_cast<int>(px.x()), mv = static_cast<int>(px.y());
    return mu < mask.cols && mv < mask.rows && mask.at<unsigned char>(mv, mu) != 0;
  }
};

TemplateLevel sample_level(const Image& image, const Region& region, const Vector2d& centre_px,
                           double half_px, int max_samples) {
  std::vector<Eigen::Vector2i> pixels;
  for (int v = region.top; v <= region.bottom; ++v)
    for (int u = region.left; u <= region.right; ++u)
      if (region.contains(u, v)) pixels.emplace_back(u, v);
  const int step = std::max(
      1, static_cast<int>(std::ceil(std::sqrt(static_cast<double>(pixels.size()) / max_samples))));
  TemplateLevel level;
  level.columns = (region.right - region.left) / step + 1;
  level.rows = (region.bottom - region.top) / step + 1;
  const double per_unit = half_px / region.scale;  // pixels of the level
  for (const Eigen::Vector2i& px : pixels) {
    const int u = px.x(), v = px.y();
    if ((u - region.left) % step || (v - region.top) % step) continue;
    const double du = 0.5 * (image.at<float>(v, u + 1) - image.at<float>(v, u - 1));
    const double dv = 0.5 * (image.at<float>(v + 1, u) - image.at<float>(v - 1, u));
    level.samples.push_back({(px.cast<double>() * region.scale - centre_px) / half_px,
                             Vector2d(du, dv) * per_unit, image.at<float>(v, u),
                             (u - region.left) / step, (v - region.top) / step});
  }
  return level;
}

}  // namespace

PlanarTemplate::PlanarTemplate(const Image& image_ref, const std::vector<Vector2d>& polygon_px,
                               int levels, int max_samples, const Image& mask) {
  require(polygon_px.size() >= 3, "planar template: a polygon has at least three corners");
  require(levels >= 1 && max_samples >= 1, "planar template: levels and samples must be positive");
  require(mask.empty() || (mask.type() == CV_8UC1 && mask.size() == image_ref.size()),
          "planar template: the mask must be CV_8UC1 and of the image's size");
  Vector2d low = polygon_px[0], high = polygon_px[0];
  for (const Vector2d& p : polygon_px) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const Vector2d size = high - low;
  require(size.allFinite() && size.minCoeff() > 0, "planar template: a polygon without extent");
  centre_px_ = 0.5 * (low + high);
  half_px_ = 0.5 * size.maxCoeff();
  corners_px_ = {low, Vector2d(high.x(), low.y()), high, Vector2d(low.x(), high.y())};
  const auto pyramid = grey_pyramid(image_ref, levels);
  for (std::size_t i = 0; i < pyramid.size(); ++i) {
    const Region region(polygon_px, mask, pyramid[i], std::ldexp(1.0, static_cast<int>(i)));
    levels_.push_back(sample_level(pyramid[i], region, centre_px_, half_px_, max_samples));
  }
}

Eigen::Matrix3d PlanarTemplate::px_from_template() const {
  Eigen::Matrix3d N;
  N << half_px_, 0, centre_px_.x(), 0, half_px_, centre_px_.y(), 0, 0, 1;
  return N;
}

double PlanarTemplate::corner_distance_px(const Eigen::Matrix3d& Ha_cur_ref,
                                          const Eigen::Matrix3d& Hb_cur_ref) const {
  double largest = 0;
  for (const Vector2d& corner : corners_px_) {
    const auto a = map_pixel(Ha_cur_ref, corner), b = map_pixel(Hb_cur_ref, corner);
    if (!a || !b) return std::numeric_limits<double>::infinity();
    largest = std::max(largest, (*a - *b).norm());
  }
  return largest;
}

Eigen::Matrix<double, 8, Eigen::Dynamic> PlanarTemplate::corner_jacobian(
    const PlanarWarp& warp) const {
  Eigen::Matrix<double, 8, Eigen::Dynamic> J(8, warp.dof());
  for (int c = 0; c < 4; ++c) J.middleRows<2>(2 * c) = warp.pixel_jacobian(corners_px_[c]);
  return J;
}

std::optional<Eigen::Matrix3d> homography_of_box(const std::array<Vector2d, 4>& box,
                                                 const std::array<Vector2d, 4>& corners) {
  const auto cross = [](const Vector2d& a, const Vector2d& b) {
    return a.x() * b.y() - a.y() * b.x();
  };
  // Half a degree: the corner is straight. Chosen.
  constexpr double kLeastSine = 0.01;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector2d in = corners[(i + 1) % 4] - corners[i];
    const Vector2d out = corners[(i + 2) % 4] - corners[(i + 1) % 4];
    if (!(cross(in, out) > kLeastSine * in.norm() * out.norm())) return std::nullopt;
  }
  // From the unit square: (0, 0), (1, 0), (1, 1), (0, 1).
  const Vector2d across = corners[1] - corners[2], along = corners[3] - corners[2];
  const Vector2d sum = corners[0] - corners[1] + corners[2] - corners[3];
  const double area = cross(across, along);
  const double g = cross(sum, along) / area, h = cross(across, sum) / area;
  Eigen::Matrix3d square;
  square.col(0) << corners[1] - corners[0] + g * corners[1], g;
  square.col(1) << corners[3] - corners[0] + h * corners[3], h;
  square.col(2) << corners[0], 1;
  const Vector2d size = box[2] - box[0];
  Eigen::Matrix3d to_square;
  to_square << 1 / size.x(), 0, -box[0].x() / size.x(), 0, 1 / size.y(), -box[0].y() / size.y(), 0,
      0, 1;
  const Eigen::Matrix3d H = square * to_square;
  if (!(std::abs(H.determinant()) > 1e-14 * std::pow(H.norm(), 3))) return std::nullopt;
  return H;
}

}  // namespace placegraph
