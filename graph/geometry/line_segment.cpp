#include <placegraph/graph/core/error.h>
#include <placegraph/graph/geometry/line_segment.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace placegraph {

Eigen::Vector2d LineSegment::normal() const {
  const Eigen::Vector2d d = direction();
  return {-d.y(), d.x()};
}

double LineSegment::distance_to(const Eigen::Vector2d& px) const {
  const double squared = vector().squaredNorm();
  if (squared == 0) return (px - start).norm();
  const double share = std::clamp(vector().dot(px - start) / squared, 0.0, 1.0);
  return (px - start - share * vector()).norm();
}

Eigen::Vector2d ImageLine::normal() const { return {std::cos(angle_rad), std::sin(angle_rad)}; }

Eigen::Vector3d ImageLine::homogeneous() const {
  const Eigen::Vector2d n = normal();
  return {n.x(), n.y(), -offset_px};
}

Eigen::Vector2d ImageLine::foot(const Eigen::Vector2d& px) const {
  const Eigen::Vector2d n = normal();
  return px - (n.dot(px) - offset_px) * n;
}

ImageLine::Carriers ImageLine::carriers(double sigma_floor_px) const {
  require(covariance(0, 0) > 0 && covariance(1, 1) > 0, "ImageLine: its covariance is not known");
  // At an arm s from the anchor the distance varies by shift + s rotation, independently at both
  // arms if s^2 var(rotation) = var(shift).
  const double arm = std::sqrt(covariance(1, 1) / covariance(0, 0));
  const Eigen::Vector2d n = normal(), along(-n.y(), n.x());
  return {foot(anchor - arm * along), foot(anchor + arm * along),
          std::sqrt(2 * covariance(1, 1) + sigma_floor_px * sigma_floor_px)};
}

double ImageLine::variance_at(const Eigen::Vector2d& px) const {
  const Eigen::Vector2d n = normal();
  // A rotation of the normal by w moves the line at arm s along the direction (-n_v, n_u) by -s w.
  const double arm = Eigen::Vector2d(-n.y(), n.x()).dot(px - anchor);
  const Eigen::Vector2d J(-arm, 1);
  return J.dot(covariance * J);
}

std::optional<ImageLine> fit_line(const std::vector<Eigen::Vector2d>& points_px,
                                  const std::vector<double>& sigmas_px) {
  require(points_px.size() == sigmas_px.size(), "fit_line: one deviation a point needed");
  if (points_px.size() < 2) return std::nullopt;
  double weight = 0;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < points_px.size(); ++i) {
    require(sigmas_px[i] > 0, "fit_line: deviations must be positive");
    const double w = 1 / (sigmas_px[i] * sigmas_px[i]);
    weight += w;
    mean += w * points_px[i];
  }
  mean /= weight;
  Eigen::Matrix2d dispersion = Eigen::Matrix2d::Zero();
  for (std::size_t i = 0; i < points_px.size(); ++i) {
    const Eigen::Vector2d d = points_px[i] - mean;
    dispersion += d * d.transpose() / (sigmas_px[i] * sigmas_px[i]);
  }
  // The direction of largest scatter, in closed form.
  const double along = 0.5 * std::atan2(2 * dispersion(0, 1), dispersion(0, 0) - dispersion(1, 1));
  const Eigen::Vector2d direction(std::cos(along), std::sin(along));
  const double spread = direction.dot(dispersion * direction);
  if (!(spread > 1e-12 * weight)) return std::nullopt;
  ImageLine line;
  line.angle_rad = along + std::numbers::pi / 2;
  line.offset_px = line.normal().dot(mean);
  line.anchor = mean;
  line.covariance.diagonal() << 1 / spread, 1 / weight;
  return line;
}

ImageLine line_of(const LineSegment& segment, double sigma_px, double step_px) {
  const double length = segment.length();
  require(length > 0, "line_of: the segment has no length");
  require(sigma_px > 0 && step_px > 0, "line_of: sigma_px and step_px must be positive");
  const double n = std::max(2.0, std::floor(length / step_px));
  const double variance = sigma_px * sigma_px;
  const Eigen::Vector2d normal = segment.normal();
  ImageLine line;
  line.angle_rad = std::atan2(normal.y(), normal.x());
  line.anchor = segment.middle();
  line.offset_px = normal.dot(line.anchor);
  line.covariance.diagonal() << 12 * variance / (n * length * length * (1 - 1 / (n * n))),
      variance / n;
  return line;
}

Collinearity collinearity(const LineSegment& a, const LineSegment& b) {
  const bool a_longer = a.length() >= b.length();
  const LineSegment& base = a_longer ? a : b;
  const LineSegment& other = a_longer ? b : a;
  const double cosine = std::abs(base.direction().dot(other.direction()));
  const double from = base.position_of(other.start), to = base.position_of(other.end);
  Collinearity result;
  result.angle_rad = std::acos(std::min(1.0, cosine));
  result.distance_px =
      std::max(std::abs(base.offset_of(other.start)), std::abs(base.offset_of(other.end)));
  result.gap_px = std::max(std::min(from, to) - base.length(), -std::max(from, to));
  return result;
}

}  // namespace placegraph
