#pragma once
#include <CLI/App.hpp>
#include <functional>

namespace placegraph::apps {

struct LoopsArguments;
struct LoopsResult;

/// Adds `placegraph eval loops`, which evaluates place recognizers against ground truth.
/// `write_page` writes the page of `--report`.
void add_eval_loops_command(
    CLI::App& eval_group,
    const std::function<void(const LoopsArguments&, const LoopsResult&)>& write_page);

}  // namespace placegraph::apps
