#pragma once
#include <placegraph/frontend/vanishing/vanishing_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/geometry/line_segment.h>

#include <Eigen/Dense>
#include <optional>
#include <vector>

namespace placegraph {

/// Error of one segment for a vanishing direction v (unit, camera frame).
///
/// It is the angle at the middle of the segment between it and the direction to the vanishing
/// point.
struct PointingError {
  double sine = 0;                                           ///< sine of the angle
  double variance = 0;                                       ///< variance of the angle [rad^2]
  Eigen::RowVector3d J_sine_v = Eigen::RowVector3d::Zero();  ///< zero along v itself
};

/// Segments of an image as evidence for the directions of edges in a scene.
///
/// Image points are those of an ideal pinhole camera with the camera's K, relative to the principal
/// point and divided by the focal length.
class VanishingEvidence {
 public:
  /// Throws ArgumentError if a segment has no length, or a camera or noise is out of its range.
  /// Segments with an end outside the range of the camera model are not used.
  VanishingEvidence(const std::vector<LineSegment>& segments, const Camera& camera,
                    const VanishingNoise& noise);

  int size() const { return static_cast<int>(lines_.size()); }
  /// Index of the i-th line among the given segments.
  int segment(int i) const { return lines_[static_cast<std::size_t>(i)].segment; }
  /// Weight of a line as independent evidence: pieces of one edge, and the two edges of a narrow
  /// bar, are collinear for a reason other than chance and count as one.
  double weight(int i) const { return lines_[static_cast<std::size_t>(i)].weight; }
  double total_weight() const { return total_weight_; }
  /// Length of the line [focal lengths].
  double length(int i) const { return lines_[static_cast<std::size_t>(i)].length; }
  /// Unit normal of the plane through the camera centre and the line.
  const Eigen::Vector3d& normal(int i) const { return lines_[static_cast<std::size_t>(i)].normal; }

  PointingError error(int i, const Eigen::Vector3d& v) const;
  /// Log of the ratio of the density of the error to that of a line of any direction (1 / pi)
  /// [nats], for a direction with standard deviation `widen_rad`.
  double log_ratio(int i, const Eigen::Vector3d& v, double widen_rad = 0) const;
  /// Weight of a line's squared, whitened error in reweighted least squares.
  double robust_weight(const PointingError& error) const;
  /// Expected information of one error over its inverse variance (Lange, Little & Taylor 1989).
  double information_share() const;
  /// A fast log_ratio of all lines for searching, without the tails and not below zero, times their
  /// weights and minus `cost` nats each. `gains` has size() entries.
  void quick_gains(const Eigen::Vector3d& v, double cost, Eigen::Ref<Eigen::ArrayXf> gains) const;

  const VanishingNoise& noise() const { return noise_; }
  /// Estimates the noise of largest likelihood for lines that belong to the direction in `of` (an
  /// index into `directions`, negative: none), with a weak prior at the given noise.
  void fit_noise(const std::vector<Eigen::Vector3d>& directions, const std::vector<int>& of);

 private:
  struct Line {
    int segment = 0;
    double length = 0;  ///< length [focal lengths]
    double weight = 1;
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();
    Eigen::Vector2d across = Eigen::Vector2d::Zero();  ///< unit normal in the image
  };
  double variance(const Line& line, double squared_distance, double depth) const;
  void set_noise(const VanishingNoise& noise);
  void weigh_collinear();
  void pack();

  std::vector<Line> lines_;
  VanishingNoise start_, noise_;
  double focal_px_ = 1, total_weight_ = 0;
  double log_constant_ = 0;  ///< logarithm of the density of the errors times pi
  /// Variances of noise_ [focal lengths^2], [rad^2].
  double end_variance_ = 0, parallel_variance_ = 0;
  // For quick_gains, one entry per line: coefficients of the line, middle, rotation variance,
  // constants.
  Eigen::ArrayXf a_, b_, c_, x_, y_, rotation_variance_, log_gain_, weight_;
};

/// Converts labels of lines of the evidence to labels of all given `segments`; -1 for those that
/// are not used.
void spread_labels(const VanishingEvidence& evidence, std::size_t segments,
                   std::vector<int>& labels);

}  // namespace placegraph
