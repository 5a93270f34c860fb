#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// A straight edge of an image [px], from `start` to `end`.
/// A detector that measures the polarity orders the ends so that the brighter side is to the right
/// of the direction from start to end (u right, v down). The order of other detectors is arbitrary.
struct LineSegment {
  Eigen::Vector2d start = Eigen::Vector2d::Zero();  ///< first end [px]
  Eigen::Vector2d end = Eigen::Vector2d::Zero();    ///< second end [px]

  /// From start to end [px].
  Eigen::Vector2d vector() const { return end - start; }
  /// The point half-way between the ends [px].
  Eigen::Vector2d middle() const { return 0.5 * (start + end); }
  /// Distance between the ends [px]; 0 if they coincide.
  double length() const { return vector().norm(); }
  /// From start to end, of unit length; zero if the ends coincide.
  Eigen::Vector2d direction() const { return vector().normalized(); }
  /// The direction rotated by +90 degrees, (-d_v, d_u); it points to the right of the segment.
  Eigen::Vector2d normal() const;
  /// Signed distance of a point from the infinite line [px], positive where the normal points.
  double offset_of(const Eigen::Vector2d& px) const { return normal().dot(px - start); }
  /// Position of a point's foot along the line, from start [px]; may be outside [0, length].
  double position_of(const Eigen::Vector2d& px) const { return direction().dot(px - start); }
  /// Distance of a point from the segment, its ends included [px].
  double distance_to(const Eigen::Vector2d& px) const;
};

/// An infinite line of an image, n^T p = offset with n = (cos angle, sin angle).
/// The ends of an edge depend on the detector, the infinite line through them does not.
struct ImageLine {
  double angle_rad = 0;  ///< direction of the normal, from the u axis towards v
  double offset_px = 0;  ///< signed distance of the line from pixel (0, 0) along the normal
  /// Covariance of [rotation about `anchor`, shift along the normal at `anchor`], rad and px.
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  /// The weighted mean of the edge points [px]: there rotation and shift are uncorrelated.
  Eigen::Vector2d anchor = Eigen::Vector2d::Zero();

  /// The unit normal (cos angle, sin angle).
  Eigen::Vector2d normal() const;
  /// Homogeneous line (n, -offset) with |n| = 1: l^T (u, v, 1) is a signed distance [px].
  Eigen::Vector3d homogeneous() const;
  /// The point of the line that is nearest to `px` [px].
  Eigen::Vector2d foot(const Eigen::Vector2d& px) const;
  /// Variance of the line's signed distance to a fixed point [px^2].
  /// It grows with the distance of the point's foot from the anchor.
  double variance_at(const Eigen::Vector2d& px) const;
  /// Two points of the line where its distances are independent and equally well known.
  /// They represent the infinite line with its covariance, independently of the ends of its
  /// segment.
  struct Carriers {
    Eigen::Vector2d first, second;  ///< points of the line, on both sides of the anchor [px]
    double sigma_px = 0;            ///< standard deviation of the line's distance at either point
  };
  /// The carriers of the line, with no deviation below `sigma_floor_px`.
  /// The covariance must be diagonal, as `fit_line` and `line_of` leave it; throws ArgumentError if
  /// a variance is not positive.
  Carriers carriers(double sigma_floor_px = 0) const;
};

/// The line through edge points [px] by total least squares, with a covariance.
/// `sigmas_px` are the standard deviations of the points across the line: one positive value for
/// each point, else ArgumentError. The covariance is that of the normal equations. Nothing if there
/// are fewer than two points or all points coincide.
std::optional<ImageLine> fit_line(const std::vector<Eigen::Vector2d>& points_px,
                                  const std::vector<double>& sigmas_px);

/// The line of a segment whose edge was measured independently every `step_px`.
/// Each of the n measurements (2 at least) has a standard deviation of `sigma_px` across the edge,
/// so the variances are sigma^2 / n of the shift and 12 sigma^2 / (n (L^2 - (L/n)^2)) of the
/// rotation. Throws ArgumentError if the segment has no length or a parameter is not positive.
ImageLine line_of(const LineSegment& segment, double sigma_px = 0.3, double step_px = 2);

/// Deviation of two segments from a common line, relative to the longer segment.
struct Collinearity {
  double angle_rad = 0;  ///< angle between the lines, 0 .. pi/2
  /// Distance of the shorter segment's farther end from the line of the longer one.
  double distance_px = 0;
  double gap_px = 0;  ///< gap between the segments along the line; negative: their overlap
};
/// Compares two segments of non-zero length; their order does not matter.
Collinearity collinearity(const LineSegment& a, const LineSegment& b);

}  // namespace placegraph
