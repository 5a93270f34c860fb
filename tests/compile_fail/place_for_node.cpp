// A place's id where its node's is due.
#include <placegraph/graph/pose_graph/constraint.h>

namespace placegraph {
void wrong(RelativePoseConstraint& edge, PlaceId place) { edge.from = place; }
}  // namespace placegraph
