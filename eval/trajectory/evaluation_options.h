#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/geometry/trajectory.h>

#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// The transformation that is fitted before an estimate is compared with the ground truth.
enum class Alignment {
  kNone,    ///< none: the estimate is compared unchanged
  kOrigin,  ///< the first associated pose is aligned with the ground truth's; nothing is fitted
  kSe3,     ///< rotation and translation by least squares of the positions
  kSim3,    ///< rotation, translation and scale
  kScale,   ///< as kOrigin, and one scale fitted about that first pose
};

/// How poses of the estimate are paired with poses of the ground truth.
enum class Association {
  kAuto,   ///< by time if both have times, by index if neither has; otherwise refused
  kIndex,  ///< frames of the same number: line i with line i, both of the same length, unless the
           ///< files number their frames
  kTime,   ///< nearest stamps
};

/// Segments of the relative errors t_rel and r_rel; the defaults are those of KITTI.
struct SegmentOptions {
  /// Lengths of the segments along the true path.
  std::vector<double> lengths_m = {100, 200, 300, 400, 500, 600, 700, 800};
  int step = 10;                 ///< frames between the starts of two segments
  double frame_rate_hz = 10;     ///< frame rate for speeds, if the ground truth has no times
  double speed_bin_m_per_s = 2;  ///< width of an interval of speed in the table per speed
  void check() const;
};
void visit(OptionVisitor& field, SegmentOptions& options);

/// Options of the comparison of an estimated trajectory with the ground truth.
struct EvaluationOptions {
  Alignment alignment = Alignment::kSe3;         ///< transformation fitted before the comparison
  Association association = Association::kAuto;  ///< association of poses
  AssociationOptions time;                       ///< options of the association by time
  SegmentOptions segments;                       ///< segments of t_rel and r_rel
  void check() const;
};
void visit(OptionVisitor& field, EvaluationOptions& options);

}  // namespace placegraph
