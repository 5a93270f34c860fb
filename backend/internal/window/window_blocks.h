#pragma once
#include <placegraph/backend/internal/window/window_state.h>
#include <placegraph/graph/core/ids.h>

namespace placegraph {

/// The estimates of a window as blocks of numbers (see VariableBlock) that a solver moves. Ceres
/// orders the blocks of one elimination group by address, and the order decides the last bits of
/// the sums: the blocks of keyframes, worlds, lines and planes lie in one array, by kind and in the
/// order of the ids, and so do those of points.
class WindowBlocks {
 public:
  explicit WindowBlocks(const WindowState& state);

  /// Keyframes, planes, worlds, as variables_of() has them.
  const std::vector<WindowVariable>& variables() const { return variables_; }
  std::size_t keyframes() const { return keyframes_; }
  /// Place of a keyframe among variables(). It must be in the window.
  std::size_t position(KeyframeId keyframe) const;

  double* variable(std::size_t k) { return &blocks_[offsets_[k]]; }
  const double* variable(std::size_t k) const { return &blocks_[offsets_[k]]; }
  double* at(const WindowVariable& variable);
  /// The k-th line or point in the order of the ids.
  double* line(std::size_t k) { return &blocks_[first_line_ + VariableBlock<Line3>::kSize * k]; }
  const double* line(std::size_t k) const {
    return &blocks_[first_line_ + VariableBlock<Line3>::kSize * k];
  }
  double* point(std::size_t k) { return &points_[3 * k]; }
  const double* point(std::size_t k) const { return &points_[3 * k]; }

  bool finite() const;

 private:
  std::vector<WindowVariable> variables_;
  std::vector<std::size_t> offsets_;  ///< of the variables in `blocks_`
  std::size_t keyframes_ = 0, first_line_ = 0;
  std::vector<double> blocks_;  ///< keyframes, worlds, lines, planes
  std::vector<double> points_;
};

}  // namespace placegraph
