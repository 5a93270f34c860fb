#pragma once
#include <placegraph/eval/trajectory/delta.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/geometry/trajectory.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// The transformation that is fitted before an estimate is compared with the ground truth.
enum class Alignment {
  kNone,    ///< none: the estimate is compared unchanged
  kOrigin,  ///< the first associated pose is aligned with the ground truth's; nothing is fitted
  kSe3,     ///< rotation and translation by least squares of the positions
  kSim3,    ///< rotation, translation and scale
  kScale,   ///< as kOrigin, and one scale fitted about that first pose
  kYaw,     ///< translation and rotation about the vertical, where gravity is known
};

/// The vertical of the ground truth's world.
enum class Vertical {
  kEstimated,  ///< the axis about which the ground truth turns
  kX,          ///< the world's x
  kY,          ///< the world's y, as in the frame of a camera that looks ahead
  kZ,          ///< the world's z
};

/// The poses that an alignment is fitted to; errors are computed of all poses.
struct AlignmentSpan {
  enum class Unit {
    kAll,      ///< every posed frame
    kFrames,   ///< frames of the ground truth by their number
    kSeconds,  ///< time since the first posed frame
    kPoses,    ///< posed frames by their order
  };
  Unit unit = Unit::kAll;  ///< what begin and end count
  double begin = 0;        ///< first value that belongs to the span
  double end = 1e12;       ///< first value behind it
  void check() const;
};
void visit(OptionVisitor& field, AlignmentSpan& options);

/// Name of an alignment on the command line and in results: "none", "origin", "se3", ...
std::string to_string(Alignment alignment);
/// The span in words: "frames 0:50"; empty for all.
std::string to_string(const AlignmentSpan& span);

/// Which part of the position errors is judged.
enum class ErrorPart {
  kSpace,   ///< the whole error
  kXy,      ///< its part in the plane of the world's x and y
  kXz,      ///< its part in the plane of x and z
  kYz,      ///< its part in the plane of y and z
  kFitted,  ///< its part in the plane that fits the true positions best
  kX,       ///< its part along x
  kY,       ///< its part along y
  kZ,       ///< its part along z
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

/// Relative errors besides those of consecutive frames.
struct RelativeErrorOptions {
  std::vector<Delta> deltas;                        ///< lengths of the steps, each judged by itself
  StepPairs pairs = StepPairs::kConsecutive;        ///< where the steps begin
};
void visit(OptionVisitor& field, RelativeErrorOptions& options);

/// Options of the comparison of an estimated trajectory with the ground truth.
struct EvaluationOptions {
  Alignment alignment = Alignment::kSe3;         ///< transformation fitted before the comparison
  AlignmentSpan align_over;                      ///< poses that it is fitted to
  Vertical vertical = Vertical::kEstimated;      ///< of the truth's world
  ErrorPart part = ErrorPart::kSpace;            ///< part of the position errors that is judged
  Association association = Association::kAuto;  ///< association of poses
  AssociationOptions time;                       ///< options of the association by time
  SegmentOptions segments;                       ///< segments of t_rel and r_rel
  RelativeErrorOptions relative;                 ///< relative errors over other steps
  void check() const;
};
void visit(OptionVisitor& field, EvaluationOptions& options);

}  // namespace placegraph
