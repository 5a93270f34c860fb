#include <placegraph/backend/window/window_blocks.h>

#include <algorithm>
#include <cmath>

namespace placegraph {

WindowBlocks::WindowBlocks(const WindowState& state)
    : variables_(variables_of(state)),
      offsets_(variables_.size()),
      keyframes_(state.keyframes.size()),
      points_(3 * state.landmarks.size()) {
  std::size_t size = 0;
  const auto place = [&](WindowVariable::Kind kind, std::size_t block_size) {
    for (std::size_t k = 0; k < variables_.size(); ++k) {
      if (variables_[k].kind != kind) continue;
      offsets_[k] = size;
      size += block_size;
    }
  };
  place(WindowVariable::Kind::kKeyframe, VariableBlock<SE3>::kSize);
  place(WindowVariable::Kind::kManhattanFrame, VariableBlock<SO3>::kSize);
  first_line_ = size;
  size += VariableBlock<Line3>::kSize * state.lines.size();
  place(WindowVariable::Kind::kPlane, VariableBlock<Plane3>::kSize);
  blocks_.resize(size);
  for (std::size_t k = 0; k < variables_.size(); ++k)
    store_block(value_of(state, variables_[k]), variable(k));
  std::size_t k = 0;
  for (const auto& [id, one] : state.lines) VariableBlock<Line3>::store(one.line_map, line(k++));
  k = 0;
  for (const auto& [id, landmark] : state.landmarks)
    VariableBlock<Eigen::Vector3d>::store(landmark.p_map, point(k++));
}

std::size_t WindowBlocks::position(KeyframeId keyframe) const {
  const auto end = variables_.begin() + static_cast<std::ptrdiff_t>(keyframes_);
  return static_cast<std::size_t>(
      std::lower_bound(variables_.begin(), end, keyframe_variable(keyframe)) - variables_.begin());
}

double* WindowBlocks::at(const WindowVariable& variable) {
  const auto it = std::lower_bound(variables_.begin(), variables_.end(), variable);
  return this->variable(static_cast<std::size_t>(it - variables_.begin()));
}

bool WindowBlocks::finite() const {
  const auto good = [](double x) { return std::isfinite(x); };
  return std::all_of(blocks_.begin(), blocks_.end(), good) &&
         std::all_of(points_.begin(), points_.end(), good);
}

}  // namespace placegraph
