#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/geometry/trajectory.h>

#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// What is fitted before an estimate is compared with the ground truth.
enum class Alignment {
  kNone,    ///< nothing: the estimate as it stands
  kOrigin,  ///< the first associated pose is put on the ground truth's; nothing is fitted
  kSe3,     ///< rotation and translation that fit the positions best
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
  double frame_rate_hz = 10;     ///< for speeds, where the ground truth has no times
  double speed_bin_m_per_s = 2;  ///< width of an interval of speed in the table per speed
  void check() const;
};
void visit(OptionVisitor& field, SegmentOptions& options);

/// How an estimated trajectory is compared with the ground truth.
struct EvaluationOptions {
  Alignment alignment = Alignment::kSe3;         ///< what is fitted before the comparison
  Association association = Association::kAuto;  ///< how poses are paired
  AssociationOptions time;                       ///< of the association by time
  SegmentOptions segments;                       ///< of t_rel and r_rel
  void check() const;
};
void visit(OptionVisitor& field, EvaluationOptions& options);

}  // namespace placegraph
