#pragma once
#include <placegraph/io/trajectories/filter_words.h>
#include <placegraph/io/trajectories/trajectory_filter.h>

namespace placegraph {

using FilterFunction = std::function<Trajectory(const Trajectory&)>;

/// A step that a filter knows by its name.
struct FilterStepKind {
  const char* name;
  const char *form, *text;               ///< as in FilterStepForm
  FilterFunction (*parse)(FilterWords&);  ///< from the words behind the name
};

/// The steps that choose frames or change times, and those that change poses, in the order of the
/// documentation.
const std::vector<FilterStepKind>& frame_steps();
const std::vector<FilterStepKind>& pose_steps();

}  // namespace placegraph
