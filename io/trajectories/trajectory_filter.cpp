#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/trajectories/filter_steps.h>

#include <algorithm>

namespace placegraph {
namespace {

const std::vector<FilterStepKind>& step_kinds() {
  static const std::vector<FilterStepKind> kinds = [] {
    std::vector<FilterStepKind> all = frame_steps();
    all.insert(all.end(), pose_steps().begin(), pose_steps().end());
    return all;
  }();
  return kinds;
}

FilterFunction parse_step(const std::string& step) {
  FilterWords words(step);
  const std::string name = words.take("the name of a step");
  const auto kind = std::ranges::find(step_kinds(), name, &FilterStepKind::name);
  if (kind == step_kinds().end()) {
    std::string names;
    for (const FilterStepKind& each : step_kinds())
      names += (names.empty() ? "" : ", ") + std::string(each.name);
    throw ArgumentError(in_quotes(name) + " is none of " + names);
  }
  FilterFunction function = kind->parse(words);
  words.end();
  return function;
}

/// The step's number and its words, for messages.
std::string step_name(std::size_t number, std::string_view step) {
  const std::size_t begin = step.find_first_not_of(" \t\r\n");
  const std::size_t end = step.find_last_not_of(" \t\r\n");
  return fmt::format("step {} ({})", number, step.substr(begin, end - begin + 1));
}

}  // namespace

const std::vector<FilterStepForm>& filter_step_forms() {
  static const std::vector<FilterStepForm> forms = [] {
    std::vector<FilterStepForm> all;
    for (const FilterStepKind& kind : step_kinds()) all.push_back({kind.form, kind.text});
    return all;
  }();
  return forms;
}

TrajectoryFilter::TrajectoryFilter(const std::string& chain) {
  for (const std::string& step : split_chain(chain)) {
    const std::string name = step_name(steps_.size() + 1, step);
    try {
      steps_.push_back({name, parse_step(step)});
    } catch (const Error& error) {
      throw ArgumentError(name + ": " + error.what());
    }
  }
}

Trajectory TrajectoryFilter::apply(Trajectory trajectory) const {
  for (const Step& step : steps_) {
    const std::size_t before = trajectory.size();
    try {
      trajectory = step.apply(trajectory);
    } catch (const Error& error) {
      throw ArgumentError(step.name + ": " + error.what());
    }
    if (before > 0 && trajectory.posed() == 0)
      throw NoResult(fmt::format("{}: leaves no pose of {} frames", step.name, before));
  }
  return trajectory;
}

}  // namespace placegraph
