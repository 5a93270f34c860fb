#pragma once
#include <placegraph/frontend/lines/line_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/geometry/line_segment.h>

#include <Eigen/Dense>
#include <optional>
#include <vector>

namespace placegraph {

/// What one segment says of a vanishing direction v (unit, camera frame): the angle at the middle
/// of the segment between it and the way to the vanishing point.
struct PointingError {
  double sine = 0;                                           ///< of the angle
  double variance = 0;                                       ///< of it [rad^2]
  Eigen::RowVector3d J_sine_v = Eigen::RowVector3d::Zero();  ///< zero along v itself
};

/// The segments of an image as evidence for the directions in which the edges of a scene point.
/// Image points are those of an ideal pinhole camera with the camera's K, pixels relative to the
/// principal point and in units of the focal length.
class VanishingEvidence {
 public:
  /// Throws ArgumentError if a segment has no length, or a camera or noise is out of its range.
  /// Segments with an end that the camera model does not reach take no part.
  VanishingEvidence(const std::vector<LineSegment>& segments, const Camera& camera,
                    const VanishingNoise& noise);

  int size() const { return static_cast<int>(lines_.size()); }
  /// Number of the i-th line among the segments handed over.
  int segment(int i) const { return lines_[static_cast<std::size_t>(i)].segment; }
  /// Weight of a line as evidence that something is there: pieces of one edge, and the two edges of
  /// a narrow bar, lie in one line by no chance and count as one.
  double weight(int i) const { return lines_[static_cast<std::size_t>(i)].weight; }
  double total_weight() const { return total_weight_; }
  /// Of the line [focal lengths].
  double length(int i) const { return lines_[static_cast<std::size_t>(i)].length; }
  /// Unit normal of the plane through the camera's centre and the line.
  const Eigen::Vector3d& normal(int i) const { return lines_[static_cast<std::size_t>(i)].normal; }

  PointingError error(int i, const Eigen::Vector3d& v) const;
  /// Log of the density of the error over that of a line that points anywhere (1 / pi) [nats], for
  /// a direction known to `widen_rad`.
  double log_ratio(int i, const Eigen::Vector3d& v, double widen_rad = 0) const;
  /// Weight of a line's squared, whitened error in reweighted least squares.
  double robust_weight(const PointingError& error) const;
  /// Expected information of one error over its inverse variance (Lange, Little & Taylor 1989).
  double information_share() const;
  /// A quick log_ratio of all lines, without the tails and not below zero, times their weights and
  /// less `cost` nats each: for searching. `gains` has size() entries.
  void quick_gains(const Eigen::Vector3d& v, double cost, Eigen::Ref<Eigen::ArrayXf> gains) const;

  const VanishingNoise& noise() const { return noise_; }
  /// Noise of largest likelihood for lines that belong to the direction in `of` (an index into
  /// `directions`, negative: to none), held weakly to the noise that was handed over.
  void fit_noise(const std::vector<Eigen::Vector3d>& directions, const std::vector<int>& of);

 private:
  struct Line {
    int segment = 0;
    double length = 0;  ///< in focal lengths
    double weight = 1;
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();
    Eigen::Vector2d across = Eigen::Vector2d::Zero();  ///< unit normal in the image
  };
  double variance(const Line& line, double way_squared, double depth) const;
  void set_noise(const VanishingNoise& noise);
  void weigh_collinear();
  void pack();

  std::vector<Line> lines_;
  VanishingNoise start_, noise_;
  double focal_px_ = 1, total_weight_ = 0;
  double log_constant_ = 0;                          ///< of the density of the errors times pi
  double end_variance_ = 0, parallel_variance_ = 0;  ///< of noise_, in focal lengths^2 and rad^2
  // For quick_gains, one entry a line: coefficients of the line, middle, turn variance, constants.
  Eigen::ArrayXf a_, b_, c_, x_, y_, rotation_, log_gain_, weight_;
};

/// Labels of lines of the evidence turned into labels of all `segments` that were handed over; -1
/// for those that take no part.
void spread_labels(const VanishingEvidence& evidence, std::size_t segments,
                   std::vector<int>& labels);

}  // namespace placegraph
