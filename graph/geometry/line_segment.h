#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// A straight edge of an image [px], from `start` to `end`. A detector that knows the polarity puts
/// the brighter side on the right of the way from start to end (u right, v down), else the order of
/// the ends says nothing.
struct LineSegment {
  Eigen::Vector2d start = Eigen::Vector2d::Zero();
  Eigen::Vector2d end = Eigen::Vector2d::Zero();

  Eigen::Vector2d vector() const { return end - start; }
  Eigen::Vector2d middle() const { return 0.5 * (start + end); }
  double length() const { return vector().norm(); }
  /// From start to end, of unit length. The segment must have a length.
  Eigen::Vector2d direction() const { return vector().normalized(); }
  /// The direction turned by +90 degrees: (-d_v, d_u), on the right of the way in the image.
  Eigen::Vector2d normal() const;
  /// Signed distance of a point from the infinite line, positive on the side of the normal [px].
  double offset_of(const Eigen::Vector2d& px) const { return normal().dot(px - start); }
  /// How far along from start the foot of a point lies [px]; may lie outside [0, length].
  double position_of(const Eigen::Vector2d& px) const { return direction().dot(px - start); }
  /// Distance of a point from the segment, its ends included [px].
  double distance_to(const Eigen::Vector2d& px) const;
};

/// The infinite line that a segment lies on: n^T p = offset_px with n = (cos angle, sin angle), and
/// how well its support knows it. What the ends of a segment are is a chance of the image; the line
/// is not.
struct ImageLine {
  double angle_rad = 0;  ///< of the normal
  double offset_px = 0;
  /// Of [turn about `anchor`, shift along the normal at `anchor`], rad and px.
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  Eigen::Vector2d anchor = Eigen::Vector2d::Zero();  ///< the support's mean, where both part

  Eigen::Vector2d normal() const;
  /// Homogeneous line (n, -offset) with |n| = 1: l^T (u, v, 1) is a signed distance [px].
  Eigen::Vector3d homogeneous() const;
  /// The point of the line nearest to a given one.
  Eigen::Vector2d foot(const Eigen::Vector2d& px) const;
  /// Variance of the line's signed distance to a fixed point [px^2]: it grows beyond the support.
  double variance_at(const Eigen::Vector2d& px) const;
  /// Two points of the line where its distances are independent and equally well known: they stand
  /// for the infinite line with its covariance, wherever the ends of its segment are. The anchor
  /// must be where turn and shift part, as `fit_line` leaves it. `sigma_floor_px` is what no
  /// distance is known better than.
  struct Carriers {
    Eigen::Vector2d first, second;
    double sigma_px = 0;  ///< of the distance at either
  };
  Carriers carriers(double sigma_floor_px = 0) const;
};

/// The line through edge points by total least squares with the standard deviations of each across
/// it; nothing if fewer than two points or all in one place. The covariance is that of the normal
/// equations at the given deviations: [turn, shift] are uncorrelated at the weighted mean.
std::optional<ImageLine> fit_line(const std::vector<Eigen::Vector2d>& points_px,
                                  const std::vector<double>& sigmas_px);

/// The line of a segment whose edge was measured independently every `step_px` with a deviation of
/// `sigma_px` across: variances sigma^2 / n and 12 sigma^2 / (n (L^2 - (L/n)^2)).
/// Throws ArgumentError if the segment has no length, or a parameter is not positive.
ImageLine line_of(const LineSegment& segment, double sigma_px = 0.3, double step_px = 2);

/// How two segments lie to each other, seen along the longer one.
struct Collinearity {
  double angle_rad = 0;    ///< between the lines, 0 .. pi/2
  double distance_px = 0;  ///< of the shorter one's farther end from the longer one's line
  double gap_px = 0;       ///< between them along the line; negative: they overlap by so much
};
Collinearity collinearity(const LineSegment& a, const LineSegment& b);

}  // namespace placegraph
