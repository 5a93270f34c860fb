#include <placegraph/eval/trajectory/frame_pair.h>

namespace placegraph {

std::vector<double> travelled_m(const std::vector<FramePair>& pairs) {
  std::vector<double> distance_m(pairs.size(), 0.0);
  for (std::size_t i = 1; i < pairs.size(); ++i)
    distance_m[i] =
        distance_m[i - 1] +
        (pairs[i].T_world_truth.translation() - pairs[i - 1].T_world_truth.translation()).norm();
  return distance_m;
}

}  // namespace placegraph
