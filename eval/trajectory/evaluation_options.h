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

enum class Association {
  kAuto,   ///< by time if both have times, by index if neither has; otherwise refused
  kIndex,  ///< frames of the same number: line i with line i, both of the same length, unless the
           ///< files number their frames
  kTime,   ///< nearest stamps
};

struct SegmentOptions {
  std::vector<double> lengths_m = {100, 200, 300, 400, 500, 600, 700, 800};
  int step = 10;                 ///< frames between segment starts
  double frame_rate_hz = 10;     ///< for speeds, where the ground truth has no times
  double speed_bin_m_per_s = 2;  ///< width of the rows of the table per speed
  void check() const;
};
void visit(OptionVisitor& field, SegmentOptions& options);

struct EvaluationOptions {
  Alignment alignment = Alignment::kSe3;
  Association association = Association::kAuto;
  AssociationOptions time;  ///< of the association by time
  SegmentOptions segments;
  void check() const;
};
void visit(OptionVisitor& field, EvaluationOptions& options);

}  // namespace placegraph
