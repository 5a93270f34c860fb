#pragma once
#include <placegraph/eval/loops/same_view.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/geometry/trajectory.h>
#include <placegraph/graph/recognition/loop_truth.h>

#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Criteria for a revisit of a place; the defaults suit drives at 10 Hz.
struct RevisitOptions {
  SameView same;      ///< criteria for two poses with the same view
  int min_age = 300;  ///< minimum number of images from the older to the younger
  void check() const;
};
void visit(OptionVisitor& field, RevisitOptions& options);

/// Finds the true loop closures of a trajectory that has one pose T_world_cam per image [m].
///
/// Images without a pose are not judged and are no matches; images too early for an old enough
/// candidate are listed without a match. Of positions alone distances decide. Throws ArgumentError
/// for options that check() refuses.
LoopTruth loop_truth_from_poses(const Trajectory& truth, const RevisitOptions& options);

/// Finds which images of a database show the places of queries, from the poses of both.
///
/// One pose T_world_cam per image, in one frame [m]. Queries without a pose are not judged, database images
/// without one are no matches. If either has positions alone, distances decide. Throws ArgumentError
/// for options that check() refuses.
LoopTruth loop_truth_between(const Trajectory& queries, const Trajectory& database,
                             const SameView& same);

/// What speaks against comparing the headings of true poses.
/// They are unknown, or never change. Nothing where any heading agrees (`heading_deg` of 180).
std::vector<Doubt> heading_doubts(const Trajectory& truth, const SameView& same);

}  // namespace placegraph
