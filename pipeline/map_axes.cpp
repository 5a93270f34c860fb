#include <placegraph/pipeline/map_axes.h>

namespace placegraph {

void hold_map_axes(SlidingWindow& window) {
  if (window.world(kMapAxes)) return;
  constexpr double kExactRad = 1e-4;
  const std::int64_t oldest = window.keyframes().front();
  window.add_world(kMapAxes, SO3());
  window.add_world_observation({oldest, kMapAxes, window.pose(oldest).rotation().inverse(),
                                Eigen::Matrix3d::Identity() / (kExactRad * kExactRad)});
  window.keep_world(kMapAxes);
  window.hold_world(kMapAxes);
}

}  // namespace placegraph
