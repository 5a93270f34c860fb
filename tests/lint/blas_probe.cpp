// The smallest program that uses the backend: what is bound when it is loaded is what is tested.
#include <placegraph/backend/pose_graph/pose_graph_optimizer.h>

int main() {
  placegraph::PoseGraph graph;
  graph.nodes = {{placegraph::NodeId(0), placegraph::SE2(), true},
                 {placegraph::NodeId(1), placegraph::SE2(1, 0, 0), false}};
  placegraph::RelativePoseConstraint constraint;
  constraint.to = placegraph::NodeId(1);
  constraint.T_from_to = placegraph::SE2(2, 0, 0.5);
  constraint.information = Eigen::Matrix3d::Identity();
  graph.constraints = {constraint};
  return placegraph::optimize_pose_graph(graph, {}).outcome ? 0 : 1;
}
