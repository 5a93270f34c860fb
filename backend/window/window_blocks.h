#pragma once
#include <placegraph/backend/window/window_state.h>
#include <placegraph/graph/core/ids.h>

namespace placegraph {

/// The estimates of a window as blocks of numbers (see VariableBlock) for a solver.
/// Ceres orders the blocks of one elimination group by address, and the order determines the last
/// bits of the sums. So the blocks of keyframes, Manhattan frames, lines and planes are in one
/// array, by kind and in the order of the ids; those of points are in another one.
class WindowBlocks {
 public:
  explicit WindowBlocks(const WindowState& state);

  /// Keyframes, planes and Manhattan frames, in the order of variables_of().
  const std::vector<WindowVariable>& variables() const { return variables_; }
  std::size_t keyframes() const { return keyframes_; }
  /// Position of a keyframe in variables(). It must be in the window.
  std::size_t position(KeyframeId keyframe) const;

  double* variable(std::size_t k) { return &blocks_[offsets_[k]]; }
  const double* variable(std::size_t k) const { return &blocks_[offsets_[k]]; }
  double* at(const WindowVariable& variable);
  /// The block of the k-th line or point in the order of the ids.
  double* line(std::size_t k) { return &blocks_[first_line_ + VariableBlock<Line3>::kSize * k]; }
  const double* line(std::size_t k) const {
    return &blocks_[first_line_ + VariableBlock<Line3>::kSize * k];
  }
  double* point(std::size_t k) { return &points_[3 * k]; }
  const double* point(std::size_t k) const { return &points_[3 * k]; }

  bool finite() const;

 private:
  std::vector<WindowVariable> variables_;
  std::vector<std::size_t> offsets_;  ///< first number of each variable in `blocks_`
  std::size_t keyframes_ = 0, first_line_ = 0;
  std::vector<double> blocks_;  ///< keyframes, Manhattan frames, lines, planes
  std::vector<double> points_;
};

}  // namespace placegraph
