#include <placegraph/graph/constraint.h>

namespace placegraph {

int degrees_of_freedom(PoseKind kind) {
  switch (kind) {
    case PoseKind::kSE2:
      return SE2::kDof;
    case PoseKind::kSE3:
      return SE3::kDof;
    case PoseKind::kSim3:
      break;
  }
  return Sim3::kDof;
}

}  // namespace placegraph
