#pragma once
#include <CLI/App.hpp>
#include <functional>

namespace placegraph::apps {

struct EvalArguments;
struct EvalResult;

/// Adds the options that say how a trajectory is judged: alignment, segments, association, times.
void add_protocol_options(CLI::App& command, EvalArguments& arguments);

/// Adds `placegraph eval trajectory TRUTH EST...`, which evaluates estimated trajectories.
/// `write_page` writes the page of `--report`.
void add_eval_trajectory_command(
    CLI::App& eval_group,
    const std::function<void(const EvalArguments&, const EvalResult&)>& write_page);

}  // namespace placegraph::apps
