#pragma once
#include <placegraph/eval/loops/same_view.h>
#include <placegraph/graph/geometry/trajectory.h>
#include <placegraph/graph/loop_truth.h>

namespace [[gnu::visibility("default")]] placegraph {

/// What counts as a revisit. The defaults are those of drives at 10 Hz.
struct RevisitOptions {
  SameView same;
  int min_age = 300;  ///< images from the older to the younger, at least
  void check() const;
};
void visit(OptionVisitor& field, RevisitOptions& options);

/// Revisits of a trajectory that has one pose per image. Images without a pose are not judged, nor
/// are they matches; those that are too early for an old enough candidate are listed without one.
LoopTruth loop_truth_from_poses(const Trajectory& truth, const RevisitOptions& options);

}  // namespace placegraph
