#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// A straight edge of an image [px], from `start` to `end`.
/// A detector that knows the polarity orders the ends so that the brighter side lies on the right
/// when going from start to end (u right, v down). From another detector the order means nothing.
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
  /// The direction turned by +90 degrees, (-d_v, d_u); it points to the right of the segment.
  Eigen::Vector2d normal() const;
  /// Signed distance of a point from the infinite line [px], positive where the normal points.
  double offset_of(const Eigen::Vector2d& px) const { return normal().dot(px - start); }
  /// Position of a point's foot along the line, from start [px]; may lie outside [0, length].
  double position_of(const Eigen::Vector2d& px) const { return direction().dot(px - start); }
  /// Distance of a point from the segment, its ends included [px].
  double distance_to(const Eigen::Vector2d& px) const;
};

/// An infinite line of an image, n^T p = offset with n = (cos angle, sin angle).
/// Where an edge ends in an image depends on the detector, the line that it lies on does not.
struct ImageLine {
  double angle_rad = 0;  ///< of the normal, from the u axis towards v
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
  /// They stand for the infinite line with its covariance, wherever the ends of its segment are.
  struct Carriers {
    Eigen::Vector2d first, second;  ///< on the line, on both sides of the anchor [px]
    double sigma_px = 0;            ///< standard deviation of the line's distance at either point
  };
  /// The carriers of the line, with no deviation below `sigma_floor_px`.
  /// The covariance must be diagonal, as `fit_line` and `line_of` leave it; throws ArgumentError if
  /// one of its variances is not positive.
  Carriers carriers(double sigma_floor_px = 0) const;
};

/// The line through edge points [px] by total least squares, with a covariance.
/// `sigmas_px` are the standard deviations of the points across the line, which must be as many and
/// positive (ArgumentError). The covariance is that of the normal equations. Nothing if there are
/// fewer than two points or all are in one place.
std::optional<ImageLine> fit_line(const std::vector<Eigen::Vector2d>& points_px,
                                  const std::vector<double>& sigmas_px);

/// The line of a segment whose edge was measured independently every `step_px`.
/// Each of the n measurements (2 at least) has a standard deviation of `sigma_px` across the edge,
/// so the variances are sigma^2 / n of the shift and 12 sigma^2 / (n (L^2 - (L/n)^2)) of the
/// rotation. Throws ArgumentError if the segment has no length or a parameter is not positive.
ImageLine line_of(const LineSegment& segment, double sigma_px = 0.3, double step_px = 2);

/// How far two segments are from lying on one line, measured along the longer one.
struct Collinearity {
  double angle_rad = 0;    ///< between the lines, 0 .. pi/2
  double distance_px = 0;  ///< of the shorter segment's farther end from the longer one's line
  double gap_px = 0;       ///< between them along the line; negative: they overlap by so much
};
/// Compares two segments, both of which must have a length; the order does not matter.
Collinearity collinearity(const LineSegment& a, const LineSegment& b);

}  // namespace placegraph
