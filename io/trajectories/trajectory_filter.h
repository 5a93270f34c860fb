#pragma once
#include <placegraph/graph/geometry/trajectory.h>

#include <functional>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// One of the steps that a TrajectoryFilter knows.
struct FilterStepForm {
  std::string form;  ///< how it is written, such as "crop A:B"
  std::string text;  ///< what it does, one line
};

/// All steps, in the order of the documentation (docs/datasets.md).
const std::vector<FilterStepForm>& filter_step_forms();

/// A chain of steps that change a trajectory, such as "crop 10:60; downsample 0.5m".
///
/// Semicolons separate the steps, which are applied from left to right. The forms are those of
/// filter_step_forms().
class TrajectoryFilter {
 public:
  /// The chain without steps.
  TrajectoryFilter() = default;
  /// Parses a chain and reads the files that it names.
  /// Throws ArgumentError with the step and its number, also for a file that cannot be read.
  explicit TrajectoryFilter(const std::string& chain);

  /// Whether there is no step.
  bool empty() const { return steps_.empty(); }
  /// The trajectory after all steps.
  /// Throws ArgumentError with the step and its number if it has no times, no orientations or too
  /// few frames for a step, NoResult if a step leaves no frame.
  Trajectory apply(Trajectory trajectory) const;

 private:
  struct Step {
    std::string name;  ///< number and words, for messages
    std::function<Trajectory(const Trajectory&)> apply;
  };
  std::vector<Step> steps_;
};

}  // namespace placegraph
